// Foxglove's protocol: what clients may send, and what the server says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "core/wire/message_limits.h"
#include "ros_messages/types.h"
#include "tests/support/effort.h"
#include "viewer/foxglove/protocol.h"

namespace tern::foxglove {
namespace {

using ::testing::HasSubstr;

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
const ClientAdvertise::Entry kCdr{1, "/goal_pose", "cdr", "geometry_msgs/msg/PoseStamped"};
const ClientAdvertise::Entry kJson{1, "/goal_pose", "json", "geometry_msgs/PoseStamped"};

ros::PoseStamped some_pose() {
  ros::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position = {1.0, -2.0, 3.0};
  return pose;
}

TEST(FoxgloveProtocol, ReadsWhatClientsSend) {
  const auto subscribe =
      parse_client_text(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":8,"channelId":0}]})");
  ASSERT_TRUE(subscribe);
  const auto& entries = std::get<Subscribe>(*subscribe).entries;
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].subscription, 7U);
  EXPECT_EQ(entries[0].channel, 3U);
  const auto advertise = parse_client_text(
      R"({"op":"advertise","channels":[{"id":2,"topic":"/goal_pose","encoding":"cdr","schemaName":"x"}]})");
  ASSERT_TRUE(advertise);
  EXPECT_EQ(std::get<ClientAdvertise>(*advertise).entries.at(0).topic, "/goal_pose");
  EXPECT_EQ(std::get<Unsupported>(*parse_client_text(R"({"op":"getParameters"})")).operation, "getParameters");
}

TEST(FoxgloveProtocol, RefusesOtherForms) {
  for (const char* text :
       {"", "[]", "7", "{}", R"({"op":3})", R"({"op":"subscribe"})", R"({"op":"subscribe","subscriptions":[3]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":0}]})",
        R"({"op":"advertise","channels":[{"id":1,"topic":"/a","encoding":"cdr"}]})", "{\"op\":\"\xFF\"}"}) {
    EXPECT_FALSE(parse_client_text(text)) << text;
  }
  std::string many = R"({"op":"unsubscribe","subscriptionIds":[0)";
  for (std::size_t k = 0; k < kMaxSubscriptions; ++k) many += ",1";
  EXPECT_FALSE(parse_client_text(many + "]}"));
  EXPECT_FALSE(parse_client_binary(bytes_of("\x01\x00\x00\x00")));
  EXPECT_FALSE(parse_client_binary(bytes_of(std::string("\x02\x00\x00\x00\x00", 5))));
}

TEST(FoxgloveProtocol, HeadsAMessageByOperationSubscriptionAndNanoseconds) {
  EXPECT_EQ(bytes_of(message_head(258, UTime{1})),
            (std::vector<std::uint8_t>{1, 2, 1, 0, 0, 0xE8, 3, 0, 0, 0, 0, 0, 0}));
}

TEST(FoxgloveProtocol, AdvertisesDefinitions) {
  const std::string text = advertise({{"/odom", &ros::ros_type<ros::Odometry>(), false}});
  EXPECT_THAT(text, HasSubstr(R"("id":0,"topic":"/odom","encoding":"cdr","schemaName":"nav_msgs/msg/Odometry")"));
  EXPECT_THAT(text, HasSubstr(R"("schemaEncoding":"ros2msg")"));
}

TEST(FoxgloveGoal, IsReadFromCdrAndJson) {
  const auto cdr = goal_position(kCdr, bytes_of(ros::encode_cdr(some_pose())), "map");
  ASSERT_TRUE(cdr);
  EXPECT_EQ(*cdr, Vec3(1.0, -2.0, 3.0));
  const auto json = goal_position(kJson, bytes_of(R"({"pose":{"position":{"x":1,"y":-2,"z":3.0}}})"), "map");
  ASSERT_TRUE(json);
  EXPECT_EQ(*json, Vec3(1.0, -2.0, 3.0));
}

TEST(FoxgloveGoal, IsRefusedInAnotherFrameOrBeyondNumbers) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e7}) {
    ros::PoseStamped pose = some_pose();
    pose.pose.position.y = bad;
    EXPECT_FALSE(goal_position(kCdr, bytes_of(ros::encode_cdr(pose)), "map")) << bad;
  }
  ros::PoseStamped pose = some_pose();
  pose.header.frame_id = "odom";
  const auto other = goal_position(kCdr, bytes_of(ros::encode_cdr(pose)), "map");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("frame"));
}

/// Overwrites, repeats, removes or cuts off some bytes.
template <class Bytes>
Bytes mutated(Bytes bytes, std::mt19937_64& random) {
  for (std::size_t n = 1 + random() % 3; n > 0 && !bytes.empty(); --n) {
    const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
    const auto end = at + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(random() % 9), bytes.end() - at);
    switch (random() % 4) {
      case 0: *at = static_cast<typename Bytes::value_type>(random()); break;
      case 1: bytes.erase(at, end); break;
      case 2: {
        const Bytes piece(at, end);
        bytes.insert(at, piece.begin(), piece.end());
        break;
      }
      default:
        if (random() % 4 == 0) bytes.erase(at, bytes.end());
    }
  }
  return bytes;
}

TEST(FoxgloveGoal, SurvivesMutatedMessages) {
  std::mt19937_64 random(11);
  const auto cdr = bytes_of(ros::encode_cdr(some_pose()));
  const auto json = bytes_of(R"({"header":{"frame_id":"map"},"pose":{"position":{"x":1,"y":-2,"z":3.0}}})");
  const auto published = bytes_of(std::string("\x01\x02\x00\x00\x00", 5) + ros::encode_cdr(some_pose()));
  const std::string texts[] = {
      R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":8,"channelId":4}]})",
      R"({"op":"unsubscribe","subscriptionIds":[7,8]})",
      R"({"op":"advertise","channels":[{"id":2,"topic":"/goal_pose","encoding":"cdr","schemaName":"x"}]})",
      R"({"op":"unadvertise","channelIds":[2]})"};
  int goals = 0, parsed = 0;
  const int mutations = support::at_effort(20'000);
  for (int k = 0; k < mutations; ++k) {
    for (const auto& [channel, whole] : {std::pair(kCdr, cdr), std::pair(kJson, json)}) {
      const auto position = goal_position(channel, mutated(whole, random), "map");
      if (!position) continue;
      ++goals;
      ASSERT_LE(position->cwiseAbs().maxCoeff(), kMaxCoordinate);
    }
    const auto bytes = mutated(published, random);
    if (const auto message = parse_client_binary(bytes)) {
      ASSERT_LE(message->payload.size(), bytes.size());
    }
    parsed += parse_client_text(mutated(texts[static_cast<std::size_t>(k) % std::size(texts)], random)) ? 1 : 0;
  }
  EXPECT_GT(goals, mutations / 20);
  EXPECT_GT(parsed, mutations / 20);
}

}  // namespace
}  // namespace tern::foxglove
