// Bytes of DimOS's messages: compared with types of LCM's own generator, there and back, and hostile ones.
#include "dimos/wire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <geometry_msgs/PoseStamped.hpp>
#include <geometry_msgs/Twist.hpp>
#include <nav_msgs/Odometry.hpp>
#include <nav_msgs/Path.hpp>
#include <random>
#include <sensor_msgs/PointCloud2.hpp>
#include <std_msgs/Bool.hpp>
#include <tf2_msgs/TFMessage.hpp>
#include <vision_msgs/Detection3DArray.hpp>
#include <visualization_msgs/MarkerArray.hpp>

#include "ros_messages/marker_types.h"
#include "tests/support/effort.h"

namespace tern::dimos {
namespace {

/// Fills every field with something else: numbers count up, lists have 0 to 3 elements.
class Filler {
 public:
  explicit Filler(std::uint64_t seed) : rng_(seed) {}
  template <class T>
  void operator()(std::string_view name, T& x) {
    if (is_field_of_dimos(name)) fill(x);
  }
  template <ros::Message T>
  void fill(T& message) {
    T::fields(message, *this);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void fill(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      x = rng_() % 2 == 0;
    } else {
      x = static_cast<T>(static_cast<double>(rng_() % 251) * (std::is_floating_point_v<T> ? 0.37 : 1.0));
    }
  }
  void fill(std::string& text) { text.assign(rng_() % 9, 'a' + static_cast<char>(rng_() % 26)); }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& list) {
    for (T& x : list) fill(x);
  }
  template <class T>
  void fill(std::vector<T>& list) {
    list.resize(rng_() % 4);
    for (T& x : list) fill(x);
  }

 private:
  std::mt19937_64 rng_;
};

template <class Theirs>
std::string bytes_of(const Theirs& message) {
  std::string bytes(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return bytes;
}

std::span<const std::uint8_t> span_of(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// Ours → theirs → bytes → ours, and the fingerprint that DimOS ships.
template <class Ours, class Theirs>
void expect_equal_bytes(std::uint64_t shipped) {
  EXPECT_EQ(fingerprint_of<Ours>(), shipped) << Ours::kName;
  EXPECT_EQ(static_cast<std::uint64_t>(Theirs::getHash()), shipped) << Ours::kName;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Ours ours;
    Filler(seed).fill(ours);
    const std::string bytes = encode(ours);
    Theirs theirs{};
    ASSERT_EQ(theirs.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
    ASSERT_EQ(bytes_of(theirs), bytes) << Ours::kName;
    const auto back = decode<Ours>(span_of(bytes));
    ASSERT_TRUE(back) << Ours::kName;
    EXPECT_EQ(encode(*back), bytes) << Ours::kName;
  }
}

TEST(Wire, HasTheBytesAndFingerprintsOfDimos) {
  expect_equal_bytes<ros::PoseStamped, geometry_msgs::PoseStamped>(0x6a82696458c279a0);
  expect_equal_bytes<ros::Twist, geometry_msgs::Twist>(0x2e7c07d7cdf7e027);
  expect_equal_bytes<ros::Path, nav_msgs::Path>(0xc3ae62acb35793e2);
  expect_equal_bytes<ros::Odometry, nav_msgs::Odometry>(0x94e17f94648cf0e4);
  expect_equal_bytes<ros::PointCloud2, sensor_msgs::PointCloud2>(0xf5eb3da1c2853175);
  expect_equal_bytes<ros::TFMessage, tf2_msgs::TFMessage>(0xc2b8a1c33a8923ec);
  expect_equal_bytes<ros::Detection3DArray, vision_msgs::Detection3DArray>(0xea027f6760f2ebd2);
  expect_equal_bytes<ros::MarkerArray, visualization_msgs::MarkerArray>(0x9cf4d95891a43112);
  expect_equal_bytes<ros::Bool, std_msgs::Bool>(0x1ebef06a50950e3e);
}

TEST(Wire, KeepsFieldsApart) {
  geometry_msgs::PoseStamped theirs;
  theirs.header.seq = 7;
  theirs.header.stamp = {};
  theirs.header.stamp.sec = 12;
  theirs.header.stamp.nsec = 34;
  theirs.header.frame_id = "world";
  theirs.pose.position.x = 1.0, theirs.pose.position.y = 2.0, theirs.pose.position.z = 3.0;
  theirs.pose.orientation.x = 4.0, theirs.pose.orientation.y = 5.0, theirs.pose.orientation.z = 6.0;
  theirs.pose.orientation.w = 7.0;
  const auto ours = decode<ros::PoseStamped>(span_of(bytes_of(theirs)));
  ASSERT_TRUE(ours);
  EXPECT_EQ(ours->header.stamp.sec, 12);
  EXPECT_EQ(ours->header.stamp.nanosec, 34U);
  EXPECT_EQ(ours->header.frame_id, "world");
  EXPECT_EQ(ours->pose.position.y, 2.0);
  EXPECT_EQ(ours->pose.orientation.w, 7.0);
}

template <class Ours>
void expect_exact(const std::string& bytes) {
  const auto message = decode<Ours>(span_of(bytes));
  if (message) {
    EXPECT_EQ(encode(*message).size(), bytes.size());
  }
}

/// Whatever the bytes: a refusal, or a message of exactly these bytes. A claimed length never takes memory.
TEST(Wire, RefusesBytesThatAreNoMessage) {
  std::mt19937_64 rng(11);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(rng() % n); };
  ros::PointCloud2 cloud;
  ros::Detection3DArray detections;
  ros::TFMessage transforms;
  ros::PoseStamped pose;
  ros::Odometry odometry;
  Filler(3).fill(cloud), Filler(4).fill(pose), Filler(5).fill(odometry);
  detections.detections.resize(2), transforms.transforms.resize(2);
  const std::array<std::string, 6> good = {encode(cloud), encode(detections), encode(transforms),
                                           encode(pose),  encode(odometry),   encode(ros::Bool{true})};
  const int mutations = support::at_effort(20'000);
  for (int k = 0; k < mutations; ++k) {
    const std::size_t which = below(good.size());
    std::string bytes = good[which];
    if (below(2) == 0) bytes.resize(below(bytes.size() + 100));
    for (std::size_t n = below(8) + 1; n > 0 && bytes.size() > 8; --n) {
      bytes[8 + below(bytes.size() - 8)] = static_cast<char>(rng() & 0xFF);
    }
    if (which == 0) expect_exact<ros::PointCloud2>(bytes);
    if (which == 1) expect_exact<ros::Detection3DArray>(bytes);
    if (which == 2) expect_exact<ros::TFMessage>(bytes);
    if (which == 3) expect_exact<ros::PoseStamped>(bytes);
    if (which == 4) expect_exact<ros::Odometry>(bytes);
    if (which == 5) expect_exact<ros::Bool>(bytes);
  }
  for (const std::string& bytes : good) {
    EXPECT_FALSE(decode<ros::Path>(span_of(bytes))) << "another type";
    EXPECT_FALSE(decode<ros::PointCloud2>(span_of(bytes + 'x')));
  }
  EXPECT_FALSE(decode<ros::Path>({}));
}

}  // namespace
}  // namespace tern::dimos
