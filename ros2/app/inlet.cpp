#include "ros2/app/inlet.h"

#include <fmt/format.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/world/flyable.h"
#include "messages/codec.h"
#include "ros2/app/outlet.h"
#include "ros2/topics.h"
#include "ros_messages/cdr.h"
#include "runtime/log.h"

namespace tern::ros2 {
namespace {

constexpr Duration kStatusPeriod{100'000}, kCloudPeriod{50'000};
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

Inlet::Inlet(Bus& bus, Participant& participant, const TopicNames& names, const std::set<std::string>& received,
             const InletOptions& options, const UavSpec& uav)
    : bus_(bus),
      participant_(participant),
      options_(options),
      begun_(bus.clock().now()),
      places_(centre_box(uav.flight_box, uav.body)),
      next_status_(begun_) {
  const auto add = [&](const ros::FeedTopic& topic) {
    Reader& reader = readers_.emplace_back();
    reader.topic = topic.name;
    reader.number = participant_.add_reader(dds_topic(topic, names, reader_qos(topic)));
  };
  for (const ros::FeedTopic& topic : transform_topics()) {
    if (!received.empty()) add(topic);
  }
  for (const ros::FeedTopic& topic : received_topics()) {
    if (received.contains(topic.name)) add(topic);
  }
  if (received.contains(topics::kOdom)) vehicle_.emplace(received.contains(topics::kFollowing));
  bus_.subscribe(channels::kUavState, [this](const UavState& state) { position_ = state.motion.p; });
  bus_.subscribe(channels::kHorizonRequest,
                 [this](const HorizonRequest& request) { places_ = centre_box(request.flight_box, request.body); });
  bus_.subscribe(channels::kGoal,
                 [this](const Goal& goal) { goals_.hear(goal, goal.header.name.sender_epoch_us == bus_.epoch_us()); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) {
    if (status.header.name.sender_epoch_us != bus_.epoch_us()) other_received_ = bus_.clock().now();
  });
}

IntakeContext Inlet::context(UTime now) const {
  return {transforms_, now, position_, options_.detection_sigma_m, options_.detection_range_m, options_.cloud_range_m};
}

template <class Message>
Inlet::Attempt Inlet::attempt(const std::string& cdr, std::optional<Refusal> (Inlet::*use)(const Message&, UTime)) {
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(cdr.data()), cdr.size());
  std::shared_ptr<const Message> message;
  if (auto decoded = ros::decode_cdr<Message>(bytes)) message = std::make_shared<const Message>(std::move(*decoded));
  return [this, message, use, size = cdr.size()](UTime now) -> std::optional<Refusal> {
    if (!message) return Refusal{fmt::format("{} bytes are no {}", size, Message::kName)};
    return (this->*use)(*message, now);
  };
}

Inlet::Attempt Inlet::attempt_for(const std::string& topic, const std::string& cdr) {
  if (topic == topics::kTf) return attempt(cdr, &Inlet::use_transforms);
  if (topic == topics::kTfStatic) return attempt(cdr, &Inlet::use_static_transforms);
  if (topic == topics::kOdom) return attempt(cdr, &Inlet::use_odometry);
  if (topic == topics::kDetections) return attempt(cdr, &Inlet::use_detections);
  if (topic == topics::kGoalPose) return attempt(cdr, &Inlet::use_goal);
  if (topic == topics::kCloud) return attempt(cdr, &Inlet::use_cloud);
  return attempt(cdr, &Inlet::use_following);
}

void Inlet::refuse(Reader& reader, const std::string& why) {
  reader.why = printable(why);
  if (reader.refused++ == 0) log::warn("{}: a message is not used: {}", reader.topic, reader.why);
}

/// Takes no more than the reader holds, however fast others send.
void Inlet::receive(Reader& reader, UTime now) {
  if (now < reader.next) return;
  const int most = reader.topic == topics::kCloud ? 1 : 100;
  for (int k = 0; k < most; ++k) {
    const auto cdr = participant_.take(reader.number);
    if (!cdr) return;
    Attempt attempt = attempt_for(reader.topic, *cdr);
    const auto refusal = attempt(now);
    if (refusal && refusal->may_come && reader.waiting.size() < kMaxWaiting) {
      reader.waiting.push_back({now + kPatience, std::move(attempt)});
    } else if (refusal) {
      refuse(reader, refusal->why);
    }
    if (reader.topic == topics::kCloud) reader.next = now + kCloudPeriod;
  }
}

void Inlet::try_waiting(Reader& reader, UTime now) {
  std::erase_if(reader.waiting, [&](const Waiting& waiting) {
    const auto refusal = waiting.attempt(now);
    if (refusal && refusal->may_come && now < waiting.until) return false;
    if (refusal) refuse(reader, refusal->why);
    return true;
  });
}

void Inlet::step(UTime now) {
  for (Reader& reader : readers_) {
    try_waiting(reader, now);
    receive(reader, now);
  }
  if (const auto goal = goals_.due(now)) bus_.publish(channels::kGoal, *goal);
  if (vehicle_) publish_status(now);
}

std::optional<Refusal> Inlet::use_odometry(const ros::Odometry& odometry, UTime now) {
  if (!is_alone(now)) return Refusal{"another process is this vehicle (VEHICLE_STATUS)"};
  const auto reading = read(odometry, context(now));
  if (!reading) return reading.error();
  const auto state = vehicle_->receive(*reading);
  if (!state) return Refusal{state.error().message};
  return refusal_of([&] { bus_.publish(channels::kUavState, *state); });
}

std::optional<Refusal> Inlet::use_detections(const ros::Detection3DArray& array, UTime now) {
  const auto frame = read(array, context(now));
  if (!frame) return frame.error();
  return refusal_of([&] { bus_.publish(channels::kObstacleObservations, *frame); });
}

std::optional<Refusal> Inlet::use_goal(const ros::PoseStamped& goal, UTime now) {
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

std::optional<Refusal> Inlet::use_cloud(const ros::PointCloud2& cloud, UTime now) {
  const auto scans = read(cloud, context(now));
  if (!scans) return scans.error();
  return refusal_of([&] { bus_.publish_paced(channels::kPointCloud, *scans); });
}

std::optional<Refusal> Inlet::use_following(const ros::Bool& following, UTime now) {
  if (vehicle_) vehicle_->receive_following(following.data, now);
  return std::nullopt;
}

std::optional<Refusal> Inlet::use_transforms(const ros::TFMessage& message, UTime now) {
  return add_transforms(message, false, now);
}

std::optional<Refusal> Inlet::use_static_transforms(const ros::TFMessage& message, UTime now) {
  return add_transforms(message, true, now);
}

std::optional<Refusal> Inlet::add_transforms(const ros::TFMessage& message, bool are_static, UTime now) {
  std::optional<Refusal> refusal;
  for (const ros::TransformStamped& transform : message.transforms) {
    if (auto added = transforms_.add(transform, are_static, now); !added) refusal = Refusal{added.error().message};
  }
  return refusal;
}

bool Inlet::is_alone(UTime now) const {
  return now - begun_ >= kListenFirst && (!other_received_ || now - *other_received_ >= kOtherSilence);
}

void Inlet::publish_status(UTime now) {
  const VehicleStatus status = vehicle_->status(now);
  if (!is_alone(now) || (now < next_status_ && status.following == followed_)) return;
  followed_ = status.following;
  next_status_ = now + kStatusPeriod;
  bus_.publish(channels::kVehicleStatus, status);
}

std::string Inlet::waiting_for(UTime now) const {
  if (!vehicle_) return "";
  return is_alone(now) ? vehicle_->status(now).why_not : "another process is this vehicle (VEHICLE_STATUS)";
}

std::string Inlet::take_trouble() {
  std::string text;
  for (Reader& reader : readers_) {
    const EndCounters counters = participant_.reader_counters(reader.number);
    if (reader.refused > 0) {
      text += fmt::format("{}{}: {} messages were not used: {}", text.empty() ? "" : "; ", reader.topic, reader.refused,
                          reader.why);
    }
    if (counters.unfitting > reader.reported.unfitting) {
      text += fmt::format("{}{}: the QoS of a writer does not fit the reader", text.empty() ? "" : "; ", reader.topic);
    }
    reader.reported = counters;
    reader.refused = 0;
  }
  return text;
}

}  // namespace tern::ros2
