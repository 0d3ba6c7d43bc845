// The bytes of ROS messages, their definitions, and what other bytes do to a reader.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <regex>

#include "ros_messages/feed.h"
#include "ros_messages/own_messages.h"
#include "ros_messages/type_hash.h"
#include "runtime/mac.h"
#include "tests/support/effort.h"

namespace tern::ros {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::uint8_t> bytes_of(const std::string& cdr) { return {cdr.begin(), cdr.end()}; }

TEST(Cdr, AlignsNumbersAndEndsTextsWithZero) {
  const std::string cdr = encode_cdr(PointField{"x", 4, 7, 1});
  const std::vector<std::uint8_t> wanted = {0, 1, 0, 0,                // little-endian
                                            2, 0, 0, 0, 'x', 0, 0, 0,  // two bytes of text, two to the next number
                                            4, 0, 0, 0, 7,   0, 0, 0, 1, 0, 0, 0};
  EXPECT_EQ(bytes_of(cdr), wanted);
}

TEST(Cdr, IsReadInBothByteOrders) {
  const std::vector<std::uint8_t> big = {0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 9};
  const auto clock = decode_cdr<Clock>(big);
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->clock.sec, 5);
  EXPECT_EQ(clock->clock.nanosec, 9U);
}

TEST(Cdr, RefusesOtherEncodingsAndLengths) {
  const std::vector<std::uint8_t> whole = bytes_of(encode_cdr(Clock{{5, 9}}));
  EXPECT_TRUE(decode_cdr<Clock>(whole));
  for (const int encoding : {2, 3, 6, 7, 255}) {  // parameter lists, XCDR2
    auto other = whole;
    other[1] = static_cast<std::uint8_t>(encoding);
    EXPECT_FALSE(decode_cdr<Clock>(other)) << encoding;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decode_cdr<Clock>(std::span(whole).first(size))) << size;
  }
  auto longer = whole;
  longer.resize(whole.size() + 4);
  EXPECT_FALSE(decode_cdr<Clock>(longer)) << "four bytes are a field, not padding";
}

Detection3DArray some_detections(std::mt19937_64& random) {
  ObservationSet frame;
  frame.at = UTime{1'700'000'000'123'456};
  std::uniform_real_distribution<double> number(-50.0, 50.0);
  for (int k = 0; k < 5; ++k) {
    frame.detections.push_back({{number(random), number(random), number(random)}, Vec3::Ones(), Vec3::Ones(), k});
  }
  return detections_of(frame, {});
}

/// A read value has no more elements than the bytes could hold; ASan and UBSan watch the rest.
TEST(Cdr, SurvivesMutatedMessages) {
  std::mt19937_64 random(7);
  int accepted = 0;
  for (int k = 0; k < 2'000 * support::effort(); ++k) {
    std::vector<std::uint8_t> bytes = bytes_of(encode_cdr(some_detections(random)));
    for (int changes = 0; changes < 1 + k % 4; ++changes) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random() % 3 == 0 ? 255 : random());
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    if (const auto read = decode_cdr<Detection3DArray>(bytes)) {
      ++accepted;
      EXPECT_LE(read->detections.size(), bytes.size());
    }
    (void)decode_cdr<PointCloud2>(bytes);
    (void)decode_cdr<TFMessage>(bytes);
    (void)decode_cdr<Odometry>(bytes);
    (void)decode_cdr<PoseStamped>(bytes);
  }
  EXPECT_GT(accepted, 0);
}

TEST(Cdr, ALengthBeyondTheBytesCostsNoMemory) {
  std::vector<std::uint8_t> bytes = bytes_of(encode_cdr(Path{}));
  bytes[bytes.size() - 1] = 0x7F;  // two milliards of poses
  EXPECT_FALSE(decode_cdr<Path>(bytes));
}

TEST(Definitions, AreTheLinesOfTheFiles) {
  EXPECT_EQ(ros_type<PoseStamped>().definition(),
            "std_msgs/Header header\n"
            "geometry_msgs/Pose pose\n"
            "================================================================================\n"
            "MSG: std_msgs/Header\n"
            "builtin_interfaces/Time stamp\n"
            "string frame_id\n"
            "================================================================================\n"
            "MSG: builtin_interfaces/Time\n"
            "int32 sec\n"
            "uint32 nanosec\n"
            "================================================================================\n"
            "MSG: geometry_msgs/Pose\n"
            "geometry_msgs/Point position\n"
            "geometry_msgs/Quaternion orientation\n"
            "================================================================================\n"
            "MSG: geometry_msgs/Point\n"
            "float64 x\n"
            "float64 y\n"
            "float64 z\n"
            "================================================================================\n"
            "MSG: geometry_msgs/Quaternion\n"
            "float64 x\n"
            "float64 y\n"
            "float64 z\n"
            "float64 w\n");
  EXPECT_THAT(ros_type<Odometry>().definition(), HasSubstr("float64[36] covariance\n"));
}

/// The hashes that ROS 2 Jazzy reports for its own definitions (`ros2 topic info -v`).
TEST(Definitions, HaveTheHashesOfRos) {
  const auto hash = [](const RosType& type) {
    const std::string text = hashed_description(type);
    std::string digits;
    for (const std::uint8_t byte : sha256(std::vector<std::uint8_t>(text.begin(), text.end()))) {
      digits += fmt::format("{:02x}", byte);
    }
    return digits;
  };
  EXPECT_EQ(hash(ros_type<Odometry>()), "3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  EXPECT_EQ(hash(ros_type<Path>()), "1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b");
  EXPECT_EQ(hash(ros_type<PoseStamped>()), "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
  EXPECT_EQ(hash(ros_type<TFMessage>()), "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  EXPECT_EQ(hash(ros_type<PointCloud2>()), "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5");
  EXPECT_EQ(hash(ros_type<Clock>()), "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
}

TEST(Definitions, OfTernsOwnMessagesObeyTheRulesOfRos) {
  const std::regex name("[a-z][a-z0-9]*(_[a-z0-9]+)*"), type("tern_msgs/msg/[A-Z][A-Za-z0-9]*");
  for (const char* lcm_type : {"plan_t", "track_set_t", "heartbeat_t", "map_chunk_t", "search_view_t"}) {
    for (const TypeDescription& part : own_type(lcm_type).types) {
      EXPECT_TRUE(std::regex_match(part.name, type)) << part.name;
      for (const FieldDescription& field : part.fields) EXPECT_TRUE(std::regex_match(field.name, name)) << field.name;
    }
  }
  EXPECT_EQ(own_type("search_view_t").name(), "tern_msgs/msg/SearchView");
  EXPECT_THAT(own_type("goal_t").definition(), StartsWith("tern_msgs/Header header"));
  EXPECT_THROW((void)own_type("unknown_t"), std::out_of_range);
}

}  // namespace
}  // namespace tern::ros
