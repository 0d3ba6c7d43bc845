// DimOS's side of the network for tests: LCM, and types that its generator made of DimOS's definitions.
#pragma once

#include <deque>
#include <functional>
#include <geometry_msgs/PoseStamped.hpp>
#include <geometry_msgs/Twist.hpp>
#include <lcm/lcm-cpp.hpp>
#include <nav_msgs/Odometry.hpp>
#include <nav_msgs/Path.hpp>
#include <sensor_msgs/PointCloud2.hpp>
#include <string>
#include <tf2_msgs/TFMessage.hpp>
#include <vision_msgs/Detection3DArray.hpp>
#include <visualization_msgs/MarkerArray.hpp>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern::dimos {

inline constexpr char kOdomChannel[] = "/odom#geometry_msgs.PoseStamped",
                      kGoalChannel[] = "/goal_request#geometry_msgs.PoseStamped",
                      kDetectionsChannel[] = "/detections#vision_msgs.Detection3DArray",
                      kLidarChannel[] = "/lidar#sensor_msgs.PointCloud2", kTfChannel[] = "/tf#tf2_msgs.TFMessage",
                      kPathChannel[] = "/path#nav_msgs.Path", kTwistChannel[] = "/movecmd_twist#geometry_msgs.Twist",
                      kMarkersChannel[] = "/tern_plan#visualization_msgs.MarkerArray";
/// A network of DimOS's own, beside Tern's default.
inline constexpr char kDimosUrl[] = "udpm://239.255.76.67:7668?ttl=0";

template <class Three>
Vec3 vec(const Three& v) {
  return {v.x, v.y, v.z};
}
template <class Three>
void set(Three& to, const Vec3& v) {
  to.x = v.x(), to.y = v.y(), to.z = v.z();
}

/// The head of a message, as DimOS's Python classes fill it in.
inline std_msgs::Header header(UTime at, const std::string& frame = "world") {
  std_msgs::Header head;
  head.seq = 0;
  head.stamp.sec = static_cast<std::int32_t>(at.us / 1'000'000);
  head.stamp.nsec = static_cast<std::int32_t>(at.us % 1'000'000 * 1'000);
  head.frame_id = frame;
  return head;
}

inline geometry_msgs::PoseStamped pose_at(UTime at, const Vec3& p, double yaw = 0.0,
                                          const std::string& frame = "world") {
  geometry_msgs::PoseStamped pose;
  pose.header = header(at, frame);
  set(pose.pose.position, p);
  pose.pose.orientation.x = pose.pose.orientation.y = 0.0;
  pose.pose.orientation.z = std::sin(yaw / 2);
  pose.pose.orientation.w = std::cos(yaw / 2);
  return pose;
}

/// Boxes without ids and classes. @param sizes  whole extents
inline vision_msgs::Detection3DArray boxes_at(UTime at, const std::vector<std::pair<Vec3, Vec3>>& centres_and_sizes,
                                              const std::string& frame = "world") {
  vision_msgs::Detection3DArray array;
  array.header = header(at, frame);
  for (const auto& [centre, size] : centres_and_sizes) {
    vision_msgs::Detection3D& box = array.detections.emplace_back();
    box.results_length = 0;
    box.header = array.header;
    box.bbox.center = pose_at(at, centre).pose;
    set(box.bbox.size, size);
  }
  array.detections_length = static_cast<std::int32_t>(array.detections.size());
  return array;
}

/// One end of DimOS's network.
class DimosPeer {
 public:
  /// Keeps what arrives on a channel. LCM's own decoder refuses what is not exactly this type.
  template <class Message>
  std::deque<Message>& keep(const std::string& channel) {
    auto kept = std::make_shared<std::deque<Message>>();
    kept_.push_back(kept);
    auto handler = std::make_shared<std::function<void(const lcm::ReceiveBuffer*)>>(
        [kept, this](const lcm::ReceiveBuffer* buffer) {
          Message message{};
          const int size = message.decode(buffer->data, 0, static_cast<int>(buffer->data_size));
          if (size == static_cast<int>(buffer->data_size))
            kept->push_back(message);
          else
            ++undecoded;
        });
    kept_.push_back(handler);
    lcm_.subscribeFunction(
        channel,
        +[](const lcm::ReceiveBuffer* buffer, const std::string&,
            std::function<void(const lcm::ReceiveBuffer*)>* receive) { (*receive)(buffer); },
        handler.get());
    return *kept;
  }
  template <class Message>
  void send(const std::string& channel, const Message& message) {
    lcm_.publish(channel, &message);
  }
  void send_bytes(const std::string& channel, const std::string& bytes) {
    lcm_.publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
  }
  void poll() {
    while (lcm_.handleTimeout(0) > 0) {
    }
  }
  int undecoded = 0;

 private:
  lcm::LCM lcm_{kDimosUrl};
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace tern::dimos
