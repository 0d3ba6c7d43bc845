#include "ros_bridge/app/ros_inlet.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "core/world/flyable.h"
#include "messages/codec.h"
#include "ros_bridge/slope.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "runtime/node.h"

namespace tern::ros {
namespace {

constexpr Duration kStatusPeriod{100'000};
constexpr char kNotAlone[] = "another process is this vehicle (VEHICLE_STATUS)";
/// VEHICLE_STATUS has 10 Hz: without one for this long there is no other vehicle.
constexpr Duration kListenFirst{350'000}, kOtherSilence{1'000'000};

/// Returns a text of others as it may be logged: short, and of printable characters.
std::string printable(const std::string& text) {
  constexpr std::size_t kMostBytes = 120;
  std::string out = text.substr(0, kMostBytes);
  for (char& c : out) {
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

/// Publishes, or returns what the message's contract says against it.
template <class Publish>
std::optional<Refusal> refusal_of(const Publish& publish) {
  try {
    publish();
    return std::nullopt;
  } catch (const std::invalid_argument& error) {
    return Refusal{error.what()};
  }
}

}  // namespace

RosInlet::RosInlet(Bus& bus, const std::set<Input>& received, const InletOptions& options, const UavSpec& uav)
    : bus_(bus),
      options_(options),
      begun_(bus.clock().now()),
      places_(centre_box(uav.flight_box, uav.body)),
      next_status_(begun_) {
  if (options_.placed) value_or_throw(transforms_.add(*options_.placed, true, begun_));
  if (received.contains(Input::Odometry) || received.contains(Input::PoseOdometry)) {
    vehicle_.emplace(received.contains(Input::Following), options_.mode);
  }
  bus_.subscribe(channels::kUavState, [this](const UavState& state) {
    position_ = state.motion.p;
    speed_ = state.motion.v.norm();
  });
  bus_.subscribe(channels::kHorizonRequest,
                 [this](const HorizonRequest& request) { places_ = centre_box(request.flight_box, request.body); });
  bus_.subscribe(channels::kGoal,
                 [this](const Goal& goal) { goals_.hear(goal, goal.header.name.sender_epoch_us == bus_.epoch_us()); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) {
    if (status.header.name.sender_epoch_us != bus_.epoch_us()) other_received_ = bus_.clock().now();
  });
}

IntakeContext RosInlet::context(UTime now) const {
  return {transforms_,
          now,
          position_,
          speed_,
          options_.detection_sigma_m,
          options_.detection_range_m,
          options_.cloud_range_m,
          options_.cloud_sensor,
          options_.world_frame,
          options_.placed ? options_.placed->child_frame_id : ""};
}

void RosInlet::refuse(const std::string& topic, const std::string& why) {
  Topic& refused = topics_[topic];
  refused.why = printable(why);
  if (refused.refused++ == 0) log::warn("{}: a message is not used: {}", topic, refused.why);
}

void RosInlet::make(const std::string& topic, Attempt attempt, UTime now, bool stays_valid) {
  const auto refusal = attempt(now);
  std::deque<Waiting>& waiting = topics_[topic].waiting;
  if (stays_valid) waiting.clear();  // the newest takes the place of the one before
  if (refusal && refusal->may_come && stays_valid) {
    refuse(topic, refusal->why);
    waiting.push_back({kNever, std::move(attempt)});
  } else if (refusal && refusal->may_come && waiting.size() < kMaxWaiting) {
    waiting.push_back({now + kPatience, std::move(attempt)});
  } else if (refusal) {
    refuse(topic, refusal->why);
  }
}

void RosInlet::step(UTime now) {
  for (auto& [name, topic] : topics_) {
    std::erase_if(topic.waiting, [&, &name = name](const Waiting& waiting) {
      const auto refusal = waiting.attempt(now);
      if (refusal && refusal->may_come && now < waiting.until) return false;
      if (refusal) refuse(name, refusal->why);
      return true;
    });
  }
  if (const auto goal = goals_.due(now)) bus_.publish(channels::kGoal, *goal);
  while (const MapFile* part = map_files_.due(now)) bus_.publish(channels::kMapFile, *part);
  if (vehicle_) publish_status(now);
}

std::optional<Refusal> RosInlet::use_odometry(const Odometry& odometry, UTime now) {
  if (!is_alone(now)) return Refusal{kNotAlone};
  const auto reading = read(odometry, context(now));
  if (!reading) return reading.error();
  return publish_state(*reading);
}

std::optional<Refusal> RosInlet::use_pose_odometry(const PoseStamped& odometry, UTime now) {
  if (!is_alone(now)) return Refusal{kNotAlone};
  auto reading = read_odometry(odometry, context(now));
  if (!reading) return reading.error();
  const auto velocity = pose_velocity_.receive(*reading);
  if (!velocity) {
    return Refusal{fmt::format("the velocity is not known: it takes {} poses within {} s", kFewestForSlope,
                               PoseVelocity::kWindow.seconds())};
  }
  reading->velocity = *velocity;
  return publish_state(*reading);
}

std::optional<Refusal> RosInlet::publish_state(const OdometryReading& reading) {
  const auto state = vehicle_->receive(reading);
  if (!state) return Refusal{state.error().message};
  return refusal_of([&] { bus_.publish(channels::kUavState, *state); });
}

std::optional<Refusal> RosInlet::use_detections(const Detection3DArray& array, UTime now) {
  const auto frame = read(array, context(now));
  if (!frame) return frame.error();
  return refusal_of([&] { bus_.publish(channels::kObstacleObservations, *frame); });
}

std::optional<Refusal> RosInlet::use_goal(const PoseStamped& goal, UTime now) {
  auto position = read(goal, context(now));
  if (!position) return position.error();
  if (options_.keep_height && !position_) return Refusal{"the vehicle's height is not known yet"};
  if (options_.keep_height) position->z() = position_->z();
  if (!places_.contains(*position)) {
    return Refusal{fmt::format("at [{:.2f}, {:.2f}, {:.2f}] the body would leave the flight box", position->x(),
                               position->y(), position->z())};
  }
  goals_.ask(*position);
  return std::nullopt;
}

std::optional<Refusal> RosInlet::use_cloud(const PointCloud2& cloud, UTime now) {
  const auto scans = read(cloud, context(now));
  if (!scans) return scans.error();
  return refusal_of([&] { bus_.publish_paced(channels::kPointCloud, *scans); });
}

std::optional<Refusal> RosInlet::use_octomap(const Octomap& octomap, UTime now) {
  auto parts = read(octomap, context(now));
  if (!parts) return parts.error();
  map_files_.set(std::move(*parts));
  return std::nullopt;
}

std::optional<Refusal> RosInlet::use_following(const Bool& following, UTime now) {
  if (vehicle_) vehicle_->receive_following(following.data, now);
  return std::nullopt;
}

std::optional<Refusal> RosInlet::use_transforms(const TFMessage& message, UTime now) {
  return add_transforms(message, false, now);
}

std::optional<Refusal> RosInlet::use_static_transforms(const TFMessage& message, UTime now) {
  return add_transforms(message, true, now);
}

std::optional<Refusal> RosInlet::add_transforms(const TFMessage& message, bool are_static, UTime now) {
  std::optional<Refusal> refusal;
  for (const TransformStamped& transform : message.transforms) {
    if (options_.placed && transform.child_frame_id == options_.placed->child_frame_id) {
      refusal = Refusal{transform.child_frame_id + ": its pose is the scenario's"};
      continue;
    }
    if (auto added = transforms_.add(transform, are_static, now); !added) refusal = Refusal{added.error().message};
  }
  return refusal;
}

bool RosInlet::is_alone(UTime now) const {
  return now - begun_ >= kListenFirst && (!other_received_ || now - *other_received_ >= kOtherSilence);
}

void RosInlet::publish_status(UTime now) {
  const VehicleStatus status = vehicle_->status(now);
  if (!is_alone(now) || (now < next_status_ && status.following == followed_)) return;
  followed_ = status.following;
  next_status_ = now + kStatusPeriod;
  bus_.publish(channels::kVehicleStatus, status);
}

std::string RosInlet::waiting_for(UTime now) const {
  if (!vehicle_) return "";
  return is_alone(now) ? vehicle_->status(now).why_not : kNotAlone;
}

std::string RosInlet::take_trouble() {
  std::string text;
  for (auto& [name, topic] : topics_) {
    if (topic.refused > 0) {
      text +=
          fmt::format("{}{}: {} messages were not used: {}", text.empty() ? "" : "; ", name, topic.refused, topic.why);
    }
    topic.refused = 0;
  }
  return text;
}

}  // namespace tern::ros
