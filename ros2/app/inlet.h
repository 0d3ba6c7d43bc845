// Passes messages of ROS to the bus.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/world/horizon.h"
#include "core/world/scenario.h"
#include "ros2/dds/participant.h"
#include "ros2/goal_sender.h"
#include "ros2/intake.h"
#include "ros2/names.h"
#include "ros2/odometry_vehicle.h"
#include "runtime/bus.h"

namespace tern::ros2 {

/// How received messages are read.
struct InletOptions {
  double detection_sigma_m = 0.1, detection_range_m = 0.0, cloud_range_m = 0.0;  ///< see IntakeContext
  bool keep_height = false;  ///< a goal gets the vehicle's height: RViz's button sends 0
};

/// Reads the topics that were asked for. A message that waits for a transform is tried again for kPatience. A refused
/// message changes nothing; it is counted, and reported with its reason.
///
/// With /odom it takes the vehicle's place: it publishes UAV_STATE and VEHICLE_STATUS, unless another process publishes
/// VEHICLE_STATUS. Goals outside the flight box are refused.
class Inlet {
 public:
  static constexpr Duration kPatience{200'000};
  static constexpr std::size_t kMaxWaiting = 16;  ///< messages per topic

  Inlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& received,
        const InletOptions& options, const UavSpec& uav);
  Inlet(const Inlet&) = delete;
  Inlet& operator=(const Inlet&) = delete;

  [[nodiscard]] bool is_empty() const { return readers_.empty(); }
  void step(UTime now);
  /// Returns what was refused since the last call, in words; empty: nothing.
  std::string take_trouble();
  /// Returns what the vehicle lacks, in words; empty: nothing.
  [[nodiscard]] std::string waiting_for(UTime now) const;

 private:
  /// Uses a message, or says why not.
  using Attempt = std::function<std::optional<Refusal>(UTime now)>;
  struct Waiting {
    UTime until;
    Attempt attempt;
  };
  struct Reader {
    std::string topic;
    int number = 0;
    std::deque<Waiting> waiting;
    std::int64_t refused = 0;  ///< since the last report
    std::string why;           ///< the newest reason
    EndCounters reported;
    UTime next{};  ///< when it is read again
  };

  void receive(Reader& reader, UTime now);
  Attempt attempt_for(const std::string& topic, const std::string& cdr);
  template <class Message>
  Attempt attempt(const std::string& cdr, std::optional<Refusal> (Inlet::*use)(const Message&, UTime));
  void try_waiting(Reader& reader, UTime now);
  void refuse(Reader& reader, const std::string& why);
  [[nodiscard]] IntakeContext context(UTime now) const;

  std::optional<Refusal> use_odometry(const ros::Odometry& odometry, UTime now);
  std::optional<Refusal> use_detections(const ros::Detection3DArray& array, UTime now);
  std::optional<Refusal> use_goal(const ros::PoseStamped& goal, UTime now);
  std::optional<Refusal> use_cloud(const ros::PointCloud2& cloud, UTime now);
  std::optional<Refusal> use_following(const ros::Bool& following, UTime now);
  std::optional<Refusal> use_transforms(const ros::TFMessage& message, UTime now);
  std::optional<Refusal> use_static_transforms(const ros::TFMessage& message, UTime now);
  std::optional<Refusal> add_transforms(const ros::TFMessage& message, bool are_static, UTime now);
  [[nodiscard]] bool is_alone(UTime now) const;
  void publish_status(UTime now);

  Bus& bus_;
  Participant& participant_;
  InletOptions options_;
  UTime begun_;
  std::deque<Reader> readers_;
  TransformBuffer transforms_;
  std::optional<OdometryVehicle> vehicle_;  ///< nullopt: another process is the vehicle
  GoalSender goals_;
  Box places_;                           ///< of the vehicle's position
  std::optional<Vec3> position_;         ///< the newest UAV_STATE's
  std::optional<UTime> other_received_;  ///< VEHICLE_STATUS of another process
  UTime next_status_;
  bool followed_ = false;
};

}  // namespace tern::ros2
