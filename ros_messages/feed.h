// Turns the messages of a flight into ROS messages, topic by topic: for files, Foxglove and DDS.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/world/goal.h"
#include "core/world/vehicle_status.h"
#include "ros_messages/description.h"
#include "ros_messages/scene.h"

namespace tern::ros {

/// A topic that the feed may write.
struct FeedTopic {
  std::string name;  ///< "/odom"
  const RosType* type = nullptr;
  bool latched = false;  ///< the newest message stays valid for readers that come later
};

namespace topics {
inline constexpr char kOdom[] = "/odom", kTf[] = "/tf", kDetections[] = "/detections", kGoalPose[] = "/goal_pose",
                      kPlan[] = "/plan", kTrajectory[] = "/trajectory", kSetpoint[] = "/setpoint",
                      kMap[] = "/map_cloud", kObstacles[] = "/tern/obstacles", kCommittedLine[] = "/tern/committed",
                      kPlanLine[] = "/tern/plan", kHulls[] = "/tern/hulls", kPlanes[] = "/tern/planes",
                      kRegions[] = "/tern/regions";
}  // namespace topics

/// How drawings are written.
enum class Drawings : std::uint8_t {
  Scenes,   ///< foxglove_msgs/msg/SceneUpdate
  Markers,  ///< visualization_msgs/msg/MarkerArray, for RViz
};

/// Returns all topics of the feed.
const std::vector<FeedTopic>& feed_topics(Drawings drawings = Drawings::Scenes);

/// Takes complete messages (joined batches, whole maps), and writes CDR.
class Feed {
 public:
  /// Gets a message: its topic, and its bytes.
  using Write = std::function<void(const FeedTopic& topic, std::string cdr)>;
  /// Tells whether a topic has readers; a topic without them costs nothing.
  using Wanted = std::function<bool(std::string_view topic)>;

  explicit Feed(
      Write write, Wanted wanted = [](std::string_view) { return true; }, Frames frames = {},
      Drawings drawings = Drawings::Scenes)
      : write_(std::move(write)), wanted_(std::move(wanted)), frames_(std::move(frames)), drawings_(drawings) {}

  void receive(const UavState& state);
  void receive_setpoint(const UavState& setpoint);
  void receive(const VehicleStatus& status) { position_sigma_ = status.position_sigma; }
  void receive(const ObservationSet& frame);
  void receive(const ObstacleTruth& complete_set);
  void receive(const TrackSet& complete_set);
  void receive(const Goal& goal);
  void receive(const HorizonRequest& request);
  /// Hulls and planes are drawn from the request and the predictions that the plan names, if they were received.
  void receive(const Plan& plan);
  void receive(const VoxelMap& map, UTime at);

 private:
  static constexpr std::size_t kKept = 32;  ///< requests and prediction sets that a plan may name

  [[nodiscard]] bool is_wanted(std::string_view topic) const { return wanted_(topic); }
  template <Message T>
  void write(std::string_view topic, const T& message);

  Write write_;
  Wanted wanted_;
  Frames frames_;
  Drawings drawings_;
  Vec3 position_sigma_ = Vec3::Zero();
  std::deque<std::pair<MessageName, UTime>> requests_;                             ///< t_s by name, the newest last
  std::deque<std::pair<std::pair<std::int64_t, std::int64_t>, TrackSet>> tracks_;  ///< by sender epoch and set
};

}  // namespace tern::ros
