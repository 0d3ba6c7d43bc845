// Passes messages of ROS, however they arrive, to the bus.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/horizon.h"
#include "ros_bridge/goal_sender.h"
#include "ros_bridge/intake.h"
#include "ros_bridge/map_file_sender.h"
#include "ros_bridge/odometry_vehicle.h"
#include "ros_bridge/pose_velocity.h"
#include "runtime/bus.h"

namespace tern::ros {

/// The meaning of a received message.
enum class Input : std::uint8_t {
  Goal,              ///< PoseStamped
  Odometry,          ///< Odometry
  PoseOdometry,      ///< PoseStamped; its velocity is derived
  Following,         ///< Bool
  Detections,        ///< Detection3DArray
  Cloud,             ///< PointCloud2
  Octomap,           ///< Octomap
  Transforms,        ///< TFMessage
  StaticTransforms,  ///< TFMessage
};

/// How received messages are read.
struct InletOptions {
  double detection_sigma_m = 0.1, detection_range_m = 0.0, cloud_range_m = 0.0;  ///< see IntakeContext
  std::string cloud_sensor = {};                                                 ///< see IntakeContext
  bool keep_height = false;               ///< a goal gets the vehicle's height: RViz's button sends 0
  std::string world_frame = kWorldFrame;  ///< the name of W
  /// A frame whose pose in W is given. Transforms of others that name it as child are refused.
  std::optional<TransformStamped> placed = {};
  std::string mode = "ROS 2";  ///< of VEHICLE_STATUS
};

/// Uses messages that a bridge received. A message that waits for a transform is tried again for kPatience. An OctoMap,
/// which may be sent only once, is tried until it fits or a newer one comes. A refused message changes nothing; it is
/// counted, and reported with its reason.
///
/// With odometry it takes the vehicle's place: it publishes UAV_STATE and VEHICLE_STATUS, unless another process
/// publishes VEHICLE_STATUS. Goals outside the flight box are refused.
class RosInlet {
 public:
  static constexpr Duration kPatience{200'000};
  static constexpr std::size_t kMaxWaiting = 16;  ///< messages per topic

  /// @param received  the inputs that will arrive
  RosInlet(Bus& bus, const std::set<Input>& received, const InletOptions& options, const UavSpec& uav);
  RosInlet(const RosInlet&) = delete;
  RosInlet& operator=(const RosInlet&) = delete;

  /// Takes a message. @param topic  for reports
  /// @param decode  decode.operator()<Message>(bytes) is the message, or nullopt if the bytes are none
  template <class Decode>
  void receive(Input input, const std::string& topic, std::span<const std::uint8_t> bytes, UTime now,
               const Decode& decode);
  void step(UTime now);
  /// Returns what was refused since the last call, in words; empty: nothing.
  std::string take_trouble();
  /// Returns what the vehicle lacks, in words; empty: nothing.
  [[nodiscard]] std::string waiting_for(UTime now) const;
  /// Returns whether this process may be the vehicle: no other one has been heard.
  [[nodiscard]] bool is_alone(UTime now) const;

 private:
  /// Uses a message, or says why not.
  using Attempt = std::function<std::optional<Refusal>(UTime now)>;
  struct Waiting {
    UTime until;
    Attempt attempt;
  };
  struct Topic {
    std::deque<Waiting> waiting;
    std::int64_t refused = 0;  ///< since the last report
    std::string why;           ///< the newest reason
  };

  template <class M, class Decode>
  Attempt attempt(std::span<const std::uint8_t> bytes, const Decode& decode,
                  std::optional<Refusal> (RosInlet::*use)(const M&, UTime));
  /// @param stays_valid  its sender does not repeat it
  void make(const std::string& topic, Attempt attempt, UTime now, bool stays_valid = false);
  void refuse(const std::string& topic, const std::string& why);
  [[nodiscard]] IntakeContext context(UTime now) const;

  std::optional<Refusal> use_odometry(const Odometry& odometry, UTime now);
  std::optional<Refusal> use_pose_odometry(const PoseStamped& odometry, UTime now);
  std::optional<Refusal> use_detections(const Detection3DArray& array, UTime now);
  std::optional<Refusal> use_goal(const PoseStamped& goal, UTime now);
  std::optional<Refusal> use_cloud(const PointCloud2& cloud, UTime now);
  std::optional<Refusal> use_octomap(const Octomap& octomap, UTime now);
  std::optional<Refusal> use_following(const Bool& following, UTime now);
  std::optional<Refusal> use_transforms(const TFMessage& message, UTime now);
  std::optional<Refusal> use_static_transforms(const TFMessage& message, UTime now);
  std::optional<Refusal> add_transforms(const TFMessage& message, bool are_static, UTime now);
  std::optional<Refusal> publish_state(const OdometryReading& reading);
  void publish_status(UTime now);

  Bus& bus_;
  InletOptions options_;
  UTime begun_;
  std::map<std::string, Topic, std::less<>> topics_;  ///< by name
  TransformBuffer transforms_;
  std::optional<OdometryVehicle> vehicle_;  ///< nullopt: another process is the vehicle
  PoseVelocity pose_velocity_;
  GoalSender goals_;
  MapFileSender map_files_;
  Box places_;                           ///< of the vehicle's position
  std::optional<Vec3> position_;         ///< the newest UAV_STATE's
  double speed_ = 0.0;                   ///< of the same, m/s
  std::optional<UTime> other_received_;  ///< VEHICLE_STATUS of another process
  UTime next_status_;
  bool followed_ = false;
};

template <class M, class Decode>
RosInlet::Attempt RosInlet::attempt(std::span<const std::uint8_t> bytes, const Decode& decode,
                                    std::optional<Refusal> (RosInlet::*use)(const M&, UTime)) {
  std::shared_ptr<const M> message;
  if (std::optional<M> decoded = decode.template operator()<M>(bytes)) {
    message = std::make_shared<const M>(std::move(*decoded));
  }
  return [this, message, use, size = bytes.size()](UTime now) -> std::optional<Refusal> {
    if (!message) return Refusal{std::to_string(size) + " bytes are no " + M::kName};
    return (this->*use)(*message, now);
  };
}

template <class Decode>
void RosInlet::receive(Input input, const std::string& topic, std::span<const std::uint8_t> bytes, UTime now,
                       const Decode& decode) {
  const auto use = [&](auto member) { make(topic, attempt(bytes, decode, member), now); };
  switch (input) {
    case Input::Goal: return use(&RosInlet::use_goal);
    case Input::Odometry: return use(&RosInlet::use_odometry);
    case Input::PoseOdometry: return use(&RosInlet::use_pose_odometry);
    case Input::Following: return use(&RosInlet::use_following);
    case Input::Detections: return use(&RosInlet::use_detections);
    case Input::Cloud: return use(&RosInlet::use_cloud);
    case Input::Octomap: return make(topic, attempt(bytes, decode, &RosInlet::use_octomap), now, true);
    case Input::Transforms: return use(&RosInlet::use_transforms);
    case Input::StaticTransforms: return use(&RosInlet::use_static_transforms);
  }
}

}  // namespace tern::ros
