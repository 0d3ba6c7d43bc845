#include "dimos/channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tern::dimos {

std::string type_name(std::string_view ros_type) {
  constexpr std::string_view kBetween = "/msg/";
  const std::size_t at = ros_type.find(kBetween);
  return fmt::format("{}.{}", ros_type.substr(0, at), ros_type.substr(at + kBetween.size()));
}

Result<std::string> type_of_channel(std::string_view channel, const std::vector<std::string>& types) {
  const std::size_t hash = channel.rfind('#');
  const std::string type(hash == std::string_view::npos ? "" : channel.substr(hash + 1));
  if (hash == std::string_view::npos || hash < 2 || channel[0] != '/') {
    return fail(fmt::format("\"{}\" is no channel of DimOS; write it as /topic#{}", channel, types.front()));
  }
  if (channel.size() > kMaxChannelBytes) {
    return fail(fmt::format("\"{}\" has {} characters; LCM allows {}", channel, channel.size(), kMaxChannelBytes));
  }
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    return fail(fmt::format("\"{}\" has the type {}; must be {}", channel, type, fmt::join(types, " or ")));
  }
  return type;
}

std::string pattern_of(std::string_view channel) {
  std::string pattern;
  for (const char c : channel) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace tern::dimos
