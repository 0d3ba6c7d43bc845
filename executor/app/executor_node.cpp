#include "executor/app/executor_node.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/world/names.h"
#include "executor/commanded_motion.h"
#include "messages/codec.h"
#include "runtime/tick.h"

namespace tern {
namespace {

constexpr Duration kSetpointPeriod{10'000}, kGoalPeriod{1'000'000}, kRefusalLogPeriod{1'000'000},
    kRemembered{1'000'000};
/// A vehicle slower than this for kStationaryFor is stationary, m/s.
constexpr double kStationarySpeed = 0.3;
constexpr Duration kStationaryFor{200'000};
/// After this long at rest, the measured error is that of hovering.
constexpr Duration kSettled{1'000'000};

}  // namespace

ExecutorNode::ExecutorNode(Bus& bus, const UavSpec& uav, const ExecutorConfig& config)
    : bus_(bus),
      uav_(uav),
      config_(config),
      tube_(config.tube_m),
      next_setpoint_(bus.clock().now()),
      next_goal_(next_setpoint_),
      next_refusal_log_(next_setpoint_) {
  bus_.subscribe(channels::kUavState, [this](const UavState& state) { on_state(state); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) { on_status(status); });
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kPlan, [this](const Plan& plan) { on_plan(plan); });
}

void ExecutorNode::on_state(const UavState& state) {
  measured_yaw_ = state.yaw;
  on_estimate_shift(resets_.add(state, bus_.received()));
  executor_ ? check_tracking(state) : wait_until_stationary(state);
}

void ExecutorNode::wait_until_stationary(const UavState& state) {
  if (!(state.motion.v.norm() <= kStationarySpeed)) {
    stationary_since_.reset();
    return;
  }
  if (!stationary_since_) stationary_since_ = state.at;
  if (state.at - *stationary_since_ >= kStationaryFor) begin(state);
}

void ExecutorNode::check_tracking(const UavState& state) {
  fall_silent_if_held_up(bus_.received());
  if (silent_since_ && state.at < *silent_since_) return;
  if (state.at < last_setpoint_ - kRemembered) return;
  const Vec3 seen = (state.motion.p - executor_->sample(state.at).p).cwiseAbs();
  const Vec3 tube = executor_->tube_at(state.at);
  const Vec3 error = persistent_error_.add(seen, bus_.received());
  const Vec3 excess = seen - tube, before = std::exchange(excess_, excess);
  if (seen.maxCoeff() > kRejoinBeyond && !(error.maxCoeff() > kRejoinBeyond)) return;
  if (silent_since_ && check_after_silence(state, seen)) return;
  if (!following_) {
    if (!has_followed_) tube_.note_error(error);
    if (error.maxCoeff() > kRejoinBeyond) rejoin(state);
    return;
  }
  const bool outside = (excess.cwiseMin(before).array() > kMinError).any();
  const bool lost = (error - tube).maxCoeff() > kRejoinBeyond;
  if (!lost) tube_.add(error, executor_->at_rest(state.at - kSettled), state.at);
  if (outside) tube_.add_exit(state.at);
  if (!std::exchange(outside_tube_, outside) && outside) {
    ++tube_exits_;
    spdlog::warn("the vehicle is ({:.2f}, {:.2f}, {:.2f}) m off its setpoint, outside its tube; {} times so far",
                 error.x(), error.y(), error.z(), tube_exits_);
  }
  if (lost) rejoin(state);
}

void ExecutorNode::fall_silent_if_held_up(UTime now) {
  if (!silent_since_ && now - last_setpoint_ > kSetpointSilence) fall_silent(now);
}

void ExecutorNode::fall_silent(UTime now) {
  silent_since_ = now;
  drop_unsent_plan();
}

void ExecutorNode::drop_unsent_plan() {
  if (!executor_->drop_unsent_plan(last_setpoint_)) return;
  spdlog::info("dropped the newest plan: no request has reported it to the vehicle");
}

bool ExecutorNode::check_after_silence(const UavState& state, const Vec3& error) {
  silent_since_.reset();
  const Vec3 tube = executor_->tube_at(state.at);
  const MotionSample mine = executor_->sample(state.at);
  const bool turns = tube.isZero(0.0) && ((state.motion.v - mine.v).cwiseAbs().maxCoeff() > kJoinTolerance ||
                                          (state.motion.a - mine.a).cwiseAbs().maxCoeff() > kJoinTolerance);
  const bool parted = turns || ((error - tube).array() > kJoinTolerance).any();
  if (parted) rejoin(state);
  last_setpoint_ = std::max(last_setpoint_, bus_.received());
  return parted;
}

void ExecutorNode::on_estimate_shift(const std::optional<Vec3>& by) {
  if (!by || !has_followed_) return;  // before the first flight, a shift moves the frame W with it
  tube_.add_shift(*by);
  spdlog::warn("the estimator has shifted the vehicle by ({:.2f}, {:.2f}, {:.2f}) m", by->x(), by->y(), by->z());
}

void ExecutorNode::update_tube(UTime now) { executor_->set_tube(tube_.width(sigma_, now), tube_.share()); }

void ExecutorNode::rejoin(const UavState& state) {
  UavState from = state;
  if (state.at <= last_setpoint_) {  // a published setpoint stays: carry the state on to just after it
    from.at = last_setpoint_ + Duration{1};
    const double later_s = (from.at - state.at).seconds();
    from.motion.p += later_s * (state.motion.v + 0.5 * later_s * state.motion.a);
    from.motion.v += later_s * state.motion.a;
  }
  executor_->rejoin(from);
  last_setpoint_ = from.at;
}

void ExecutorNode::begin(const UavState& state) {
  const Vec3& p = state.motion.p;
  executor_.emplace(uav_, state, config_);
  update_tube(state.at);
  if (goal_) executor_->set_mode(goal_->mode);
  if (following_) executor_->begin(bus_.clock().now());
  yaw_follower_.emplace(state.yaw, state.at, config_.heading);
  publish_setpoint(state.at);
  spdlog::info("begins with the vehicle at ({:.2f}, {:.2f}, {:.2f}) m", p.x(), p.y(), p.z());
}

void ExecutorNode::on_status(const VehicleStatus& status) {
  sigma_ = status.position_sigma;
  on_estimate_shift(resets_.add(status.resets, bus_.received()));
  if (!status.mode.empty() && status.mode != kPerfectMode) tube_.assume_errors();
  if (status.following == following_) return;
  following_ = status.following;
  spdlog::info("the vehicle {}", following_ ? "follows" : "does not follow: " + status.why_not);
  if (!executor_) return;
  if (following_) {
    const UTime now = bus_.clock().now();
    if (std::exchange(has_followed_, true)) {
      fall_silent(now);
    } else {
      yaw_follower_.emplace(measured_yaw_, last_setpoint_, config_.heading);
    }
    update_tube(status.at);
    return executor_->begin(now);
  }
  executor_->pause();
  drop_unsent_plan();
  log_counters();
}

void ExecutorNode::on_goal(const Goal& goal) {
  if (goal_ && goal.id <= goal_->id) return;
  spdlog::info("goal {}: mode {}, ({:.2f}, {:.2f}, {:.2f}) m", goal.id, to_string(goal.mode), goal.position.x(),
               goal.position.y(), goal.position.z());
  goal_ = goal;
  next_goal_ = bus_.clock().now();
  if (executor_) executor_->set_mode(goal.mode);
}

void ExecutorNode::on_plan(const Plan& plan) {
  if (!executor_) return;
  const UTime now = bus_.clock().now();
  const Adoption adoption = executor_->consider(plan, now);
  if (!is_refusal(adoption.verdict)) return tube_.on_answer(plan, executor_->at_rest(now), now);
  if (adoption.verdict == Verdict::Late || adoption.verdict == Verdict::TooLate) bus_.count_late(channels::kPlan);
  ++unlogged_refusals_;
  if (now < next_refusal_log_) return;
  spdlog::warn("refused the plan for request {}: {} ({}); {} refused since the last such line", plan.request_id,
               to_string(adoption), adoption.detail, unlogged_refusals_);
  unlogged_refusals_ = 0;
  next_refusal_log_ = now + kRefusalLogPeriod;
}

UTime ExecutorNode::next_wakeup() const {
  const UTime next = goal_ ? next_goal_ : kNever;
  if (!executor_) return next;
  const auto request = silent_since_ ? std::nullopt : executor_->next_wakeup();
  return std::min({next, next_setpoint_, request.value_or(kNever)});
}

void ExecutorNode::step(UTime now) {
  if (executor_) {
    fall_silent_if_held_up(now);
    const auto due = silent_since_ ? std::nullopt : executor_->next_wakeup();
    if (due && now >= *due) update_tube(now);
    const auto request = silent_since_ ? std::nullopt : executor_->next_request(now);
    if (request) bus_.publish(channels::kHorizonRequest, *request);
    if (!executor_->requests_plans()) drop_unsent_plan();
    if (now >= next_setpoint_) {
      if (!silent_since_) publish_setpoints(now);
      executor_->forget_before(now - kRemembered);
      next_setpoint_ = next_tick(next_setpoint_, kSetpointPeriod, now);
    }
  }
  if (goal_ && now >= next_goal_) {
    bus_.publish(channels::kGoal, *goal_);
    next_goal_ = next_tick(next_goal_, kGoalPeriod, now);
  }
}

/// Publishes a setpoint at each jump of the jerk since the last one, and one now. So the cubic of each setpoint leads
/// to the next setpoint.
void ExecutorNode::publish_setpoints(UTime now) {
  if (now <= last_setpoint_) return;
  UTime at = last_setpoint_;
  for (const CubicPiece& piece : executor_->pieces(last_setpoint_, now).pieces) {
    at = at + piece.duration;
    publish_setpoint(at);
  }
}

void ExecutorNode::publish_setpoint(UTime at) {
  UavState setpoint;
  setpoint.at = at;
  setpoint.motion = executor_->sample_after(at);
  setpoint.yaw = yaw_follower_->follow(setpoint.motion.v, at);
  bus_.publish(channels::kSetpoint, setpoint);
  last_setpoint_ = at;
}

void ExecutorNode::log_counters() const {
  const ExecutorCounters& counters = executor_->counters();
  spdlog::info("requests {}, answered in time {}, unanswered {}, late {}, answered twice {}", counters.requests,
               counters.answered_in_time, counters.unanswered, counters.late(), counters.answered_twice());
  for (int k = 0; k < kVerdicts; ++k) {
    const auto verdict = static_cast<Verdict>(k);
    if (counters.of(verdict) > 0) spdlog::info("plans {}: {}", to_string(verdict), counters.of(verdict));
  }
  for (int k = 0; k < kBreaches; ++k) {
    const auto breach = static_cast<Breach>(k);
    if (counters.of(breach) > 0) spdlog::info("  of these for {}: {}", to_string(breach), counters.of(breach));
  }
}

NodeHealth ExecutorNode::health() const {
  if (!executor_) return {ProcessState::Waiting, "a vehicle at rest (UAV_STATE)"};
  return {ProcessState::Ready, ""};
}

}  // namespace tern
