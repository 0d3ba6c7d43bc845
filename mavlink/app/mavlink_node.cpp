#include "mavlink/app/mavlink_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "messages/codec.h"
#include "runtime/log.h"

namespace tern::mavlink {
namespace {

/// Period of polling the link.
constexpr Duration kPollPeriod{2'000};
/// 30 Hz, as a camera's estimator.
constexpr Duration kOdometryPeriod{33'000};
constexpr Duration kStatusPeriod{100'000}, kReportPeriod{10'000'000};
/// An autopilot sends HEARTBEAT once a second.
constexpr Duration kFirstHeartbeat{2'000'000};
/// VEHICLE_STATUS has 10 Hz: without one for this long there is no other bridge.
constexpr Duration kListenFirst{350'000}, kOtherSilence{1'000'000};
/// A goal this soon after the bridge stood back was sent before its sender knew: three VEHICLE_STATUS.
constexpr Duration kOrdersUnderWay{300'000};

}  // namespace

MavlinkNode::MavlinkNode(Bus& bus, std::unique_ptr<Link> link, const UavSpec& uav, const BridgeConfig& config,
                         std::optional<SigningKey> key, std::unique_ptr<Link> estimator)
    : bus_(bus),
      link_(std::move(link)),
      estimator_(std::move(estimator)),
      key_(std::move(key)),
      parser_(key_),
      bridge_(config, uav, bus.clock().now()),
      begun_(bus.clock().now()),
      next_(begun_),
      next_status_(begun_) {
  bus_.subscribe(channels::kSetpoint, [this](const UavState& setpoint) { bridge_.receive(setpoint); });
  bus_.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& m) { bridge_.receive(m.committed); });
  bus_.subscribe(channels::kPlan, [this](const Plan& plan) { bridge_.receive(plan); });
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) { on_status(status); });
  bus_.subscribe(channels::kHeartbeat, [this](const tern::Heartbeat& heartbeat) { on_heartbeat(heartbeat); });
  bus_.subscribe(channels::kVehicleTruth, [this](const UavState& seen) {
    if (seen.header.name.sender_epoch_us != bus_.epoch_us()) bridge_.receive_vision(seen);
  });
  bus_.subscribe(channels::kFlightResult, [this](const FlightResult&) { bridge_.land("the flight has ended"); });
}

MavlinkNode::~MavlinkNode() {
  if (!exit_code_ && bridge_.flies()) land();
  if (bridge_.has_set_parameters()) {
    log::error(
        "parameters of the autopilot were not restored: it is armed, it does not answer, or this process failed. The "
        "old values are in the lines \"sets …\" above");
  }
}

/// Counts its looks: the clock of a virtual flight stands still here.
void MavlinkNode::land() {
  constexpr std::chrono::milliseconds kPause(5);
  bridge_.land("asked to end");
  bridge_.end_parameters();
  const auto is_busy = [&] {
    return bridge_.stage() == Stage::Landing || (bridge_.has_set_parameters() && !bridge_.autopilot().armed());
  };
  for (auto left = std::chrono::microseconds(kLandPatience.us); left.count() > 0 && is_busy(); left -= kPause) {
    exchange(bus_.clock().now());
    publish(bus_.clock().now());
    std::this_thread::sleep_for(kPause);
  }
  next_status_ = bus_.clock().now();
  publish(next_status_);
  const bool landed = bridge_.stage() == Stage::Landed;
  log::write(landed ? log::Level::Info : log::Level::Error, "the autopilot {}",
             landed ? "has landed" : "did not report that it has landed");
}

void MavlinkNode::on_goal(const Goal& goal) {
  const bool is_first = !goal_id_;
  if (!is_first && goal.id <= *goal_id_) return;
  goal_id_ = goal.id;
  if (goal.mode != GoalMode::Go) return;
  if (is_first && goal.id < begun_.us) return bridge_.flight_is_under_way();
  if (stood_back_ && bus_.clock().now() - *stood_back_ < kOrdersUnderWay) {
    return log::warn("GOAL {} orders no flight: the bridge stood back while it was sent", goal.id);
  }
  if (executor_gave_up_) return log::warn("GOAL {} orders no flight: tern-executor has failed", goal.id);
  bridge_.order_flight();
}

void MavlinkNode::on_status(const VehicleStatus& status) {
  if (status.header.name.sender_epoch_us != bus_.epoch_us()) other_received_ = bus_.clock().now();
}

void MavlinkNode::on_heartbeat(const tern::Heartbeat& heartbeat) {
  if (heartbeat.process != "tern-executor") return;
  executor_gave_up_ = heartbeat.state == ProcessState::Failed;
  if (!executor_gave_up_) return;
  bridge_.land("tern-executor has given the vehicle up: " + heartbeat.waiting_for);
}

bool MavlinkNode::end(UTime now) {
  if (other_received_ && now - *other_received_ < kOtherSilence) return true;
  if (asked_to_end_) {
    if (now - *asked_to_end_ > kSameSignal) end_armed("asked to end again");
    return false;
  }
  asked_to_end_ = now;
  bridge_.end_parameters();
  bridge_.land("asked to end");
  next_report_ = now + kReportPeriod;
  if (is_needed()) log::warn("asked to end: goes on until the vehicle is disarmed, unless asked again");
  return false;
}

void MavlinkNode::finish_if_disarmed(UTime now) {
  const bool is_known = bridge_.autopilot().address() || now - begun_ > kFirstHeartbeat;
  if (exit_code_ || !is_known) return;
  if (!is_needed()) {
    if (!disarmed_since_) disarmed_since_ = now;
    if (bridge_.has_set_parameters() && now - *disarmed_since_ < kSetBackPatience) return;
    if (bridge_.stage() == Stage::Landed) log::info("the autopilot has landed");
    return finish(0);
  }
  disarmed_since_.reset();
  const Duration silence = now - bridge_.autopilot().last_received();
  if (silence > kLinkPatience) return end_armed(fmt::format("no message for {:.0f} s", silence.seconds()));
  if (now < next_report_) return;
  next_report_ = now + kReportPeriod;
  log::warn("still {}: {}", bridge_.autopilot().armed() ? "armed" : "engaging", bridge_.status(now).why_not);
}

void MavlinkNode::finish(int code) {
  exit_code_ = code;
  next_status_ = bus_.clock().now();
  publish(next_status_);
}

void MavlinkNode::end_armed(const std::string& why) {
  if (!is_needed()) return finish(0);
  finish(kExitArmed);
  log::critical("{}: ENDS WHILE THE VEHICLE IS ARMED in {} ({}); its pilot or its failsafe has it now", why,
                bridge_.autopilot().mode(), to_string(bridge_.stage()));
}

bool MavlinkNode::alone(UTime now) const {
  return now - begun_ >= kListenFirst && (!other_received_ || now - *other_received_ >= kOtherSilence);
}

void MavlinkNode::exchange(UTime now) {
  const std::uint64_t time = signature_time(now.us);
  while (const auto portion = link_->receive(now)) {
    const UTime came = portion->unix_us ? bus_.clock().at_system_time(*portion->unix_us) : now;
    received_ = std::max(received_, std::min(came, now));
    for (const Frame& frame : parser_.push(portion->bytes, time)) bridge_.receive(frame, received_);
    if (link_->datagrams()) parser_.drop_rest();
  }
  if (estimator_) exchange_with_estimator(now);
  bridge_.step(now);
  for (const Frame& frame : bridge_.take_frames()) {
    signature_time_ = std::max(signature_time_ + 1, time);
    link_->send(to_bytes(frame, key_ ? &*key_ : nullptr, signature_time_));
  }
  log_lines();
}

void MavlinkNode::exchange_with_estimator(UTime now) {
  const auto of_unix = [this](std::int64_t unix_us) { return bus_.clock().at_system_time(unix_us); };
  while (const auto portion = estimator_->receive(now)) {
    const UTime came = portion->unix_us ? of_unix(*portion->unix_us) : now;
    for (const Frame& frame : estimator_parser_.push(portion->bytes)) {
      bridge_.receive_companion(frame, std::min(came, now), of_unix);
    }
    if (estimator_->datagrams()) estimator_parser_.drop_rest();
  }
  for (const Frame& frame : bridge_.take_companion_frames()) estimator_->send(to_bytes(frame));
}

void MavlinkNode::log_lines() {
  for (const std::string& words : link_->take_log_lines()) log::warn("{}", words);
  for (const std::string& words : bridge_.take_log_lines()) log::info("{}", words);
}

void MavlinkNode::publish_estimate() {
  const auto& estimate = bridge_.estimate();
  if (!estimate) return;
  const auto& before = published_estimate_;
  const bool changed = before && (estimate->state != before->state || estimate->epoch != before->epoch);
  if (before && estimate->at < before->at + (changed ? Duration{1} : kOdometryPeriod)) return;
  published_estimate_ = estimate;
  bus_.publish(channels::kOdometry, *estimate);
}

void MavlinkNode::publish(UTime now) {
  publish_estimate();
  if (const auto state = bridge_.state(); state && state->at > published_state_) {
    published_state_ = state->at;
    bus_.publish(channels::kUavState, *state);
  }
  if (const auto truth = bridge_.truth(); truth && truth->at > published_truth_) {
    published_truth_ = truth->at;
    bus_.publish(channels::kVehicleTruth, *truth);
  }
  if (bridge_.stage() != Stage::StoodBack) {
    stood_back_.reset();
  } else if (!stood_back_) {
    stood_back_ = now;
  }
  const VehicleStatus status = bridge_.status(now);
  if (now < next_status_ && status.following == followed_) return;
  followed_ = status.following;
  next_status_ = now + kStatusPeriod;
  bus_.publish(channels::kVehicleStatus, status);
}

void MavlinkNode::step(UTime now) {
  if (now < next_) return;
  next_ = now + kPollPeriod;
  if (!alone(now)) return;
  exchange(now);
  publish(now);
  if (asked_to_end_) finish_if_disarmed(now);
}

NodeHealth MavlinkNode::health() const {
  const UTime now = bus_.clock().now();
  if (now - begun_ < kListenFirst) return {ProcessState::Starting, ""};
  if (!alone(now)) return {ProcessState::Waiting, "another process flies this vehicle (VEHICLE_STATUS)"};
  const VehicleStatus status = bridge_.status(now);
  if (status.following) return {ProcessState::Ready, ""};
  return {ProcessState::Waiting, status.why_not};
}

}  // namespace tern::mavlink
