#include "messages/channels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "messages/codec.h"

namespace tern {
namespace {

/// The beginning of a channel's row in docs/reference/messages.md, up to its rate.
template <class T>
std::string row_of(const Channel<T>& channel) {
  const std::string scope = channel.scope == Scope::Shared ? "shared" : "vehicle";
  const std::string type = kLcmType<T>;
  return std::string("\n| `") + channel.name + "` | [`" + type + "`](#" + type + ") | " + scope + " | " + channel.rate +
         (channel.latched ? ", latched |" : " |");
}

TEST(Channels, AreTheTableOfTheReferencePage) {
  std::ifstream file(std::string(TERN_SOURCE_FOLDER) + "/docs/reference/messages.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string text = page.substr(0, page.find("\n## Rules\n"));
  std::size_t rows = 0;
  for (std::size_t at = text.find("\n| `"); at != std::string::npos; at = text.find("\n| `", at + 1)) ++rows;
  EXPECT_EQ(rows, std::tuple_size_v<decltype(channels::kAll)>);
  for_each_channel([&](const auto& channel) { EXPECT_THAT(text, ::testing::HasSubstr(row_of(channel))); });
}

TEST(Channels, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for_each_channel([&](const auto& channel) { EXPECT_TRUE(names.insert(channel.name).second) << channel.name; });
}

TEST(Channels, AreFoundByName) {
  std::string type;
  EXPECT_TRUE(visit_channel("SETPOINT", [&]<class T>(const Channel<T>&) { type = kLcmType<T>; }));
  EXPECT_EQ(type, "uav_state_t");
  EXPECT_FALSE(visit_channel("SETPOINT_2", [](const auto&) {}));
  EXPECT_FALSE(visit_channel(
      "SETPOINT", [](const auto&) {}, std::tuple{channels::kPlan}));
}

}  // namespace
}  // namespace tern
