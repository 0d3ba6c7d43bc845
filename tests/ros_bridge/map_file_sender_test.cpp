#include "ros_bridge/map_file_sender.h"

#include <gtest/gtest.h>

namespace tern::ros {
namespace {

std::vector<MapFile> file_of(int parts, std::int64_t at_us) {
  std::vector<MapFile> file(static_cast<std::size_t>(parts));
  for (int k = 0; k < parts; ++k) {
    file[static_cast<std::size_t>(k)].at = UTime{at_us};
    file[static_cast<std::size_t>(k)].part = k;
    file[static_cast<std::size_t>(k)].bytes.resize(50'000);
  }
  return file;
}

/// Asks every 10 ms for a time. @return time, file and part of each message
struct Sent {
  UTime at;
  std::int64_t file;
  int part;
};
std::vector<Sent> run(MapFileSender& sender, UTime& now, Duration time) {
  std::vector<Sent> all;
  for (const UTime end = now + time; now < end; now = now + Duration{10'000}) {
    while (const MapFile* part = sender.due(now)) all.push_back({now, part->at.us, part->part});
  }
  return all;
}

TEST(MapFileSender, SendsNothingWithoutAFile) { EXPECT_EQ(MapFileSender().due(UTime{1}), nullptr); }

TEST(MapFileSender, RepeatsAFileWithinItsRate) {
  MapFileSender sender;
  UTime now{1'000'000'000};
  sender.set(file_of(40, 7));
  const auto sent = run(sender, now, Duration{14'000'000});
  ASSERT_EQ(sent.size(), 120u) << "at 0, 5 and 10 s";
  for (std::size_t k = 1; k < sent.size(); ++k) {
    EXPECT_EQ(sent[k].part, static_cast<int>(k % 40));
    EXPECT_GE((sent[k].at - sent[k - 1].at).us, 50'000);
  }
  EXPECT_EQ((sent[40].at - sent[0].at).us, 5'000'000);
}

TEST(MapFileSender, FinishesAFileAndThenSendsTheNewestOne) {
  MapFileSender sender;
  UTime now{1'000'000'000};
  sender.set(file_of(10, 1));
  auto sent = run(sender, now, Duration{200'000});
  sender.set(file_of(2, 2));
  sender.set(file_of(3, 3));
  for (const Sent& more : run(sender, now, Duration{1'000'000})) sent.push_back(more);
  ASSERT_EQ(sent.size(), 13u);
  for (std::size_t k = 0; k < sent.size(); ++k) EXPECT_EQ(sent[k].file, k < 10 ? 1 : 3);
}

}  // namespace
}  // namespace tern::ros
