#include "executor/app/executor_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/flyable.h"
#include "core/world/names.h"
#include "executor/app/log_counters.h"
#include "executor/commanded_motion.h"
#include "messages/codec.h"
#include "runtime/log.h"
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
/// A vehicle learns after at most this long that it no longer follows: of a pilot's switch by the next HEARTBEAT.
constexpr Duration kNoticed{1'000'000};
/// HEARTBEAT names a refused goal for this long.
constexpr Duration kGoalRefusedReported{5'000'000};

}  // namespace

ExecutorNode::ExecutorNode(Bus& bus, const UavSpec& uav, const ExecutorConfig& config)
    : bus_(bus),
      uav_(uav),
      config_(config),
      guard_(centre_box(uav.flight_box, uav.body), config.start_reach_m),
      tube_(config.tube_m),
      heading_(uav.heading),
      next_setpoint_(bus.clock().now()),
      next_goal_(next_setpoint_),
      next_refusal_log_(next_setpoint_),
      next_heading_log_(next_setpoint_) {
  bus_.subscribe(channels::kUavState, [this](const UavState& state) { on_state(state); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) { on_status(status); });
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kSpeedLimit, [this](const SpeedLimit& limit) { on_speed_limit(limit); });
  bus_.subscribe(channels::kPlan, [this](const Plan& plan) { on_plan(plan); });
  bus_.subscribe(channels::kPlanHeading, [this](const PlanHeading& heading) { on_heading(heading); });
  bus_.subscribe(channels::kHeartbeat, [this](const Heartbeat& heartbeat) { on_heartbeat(heartbeat); });
}

/// Simulator, bridge and planner count the requests that they received, also those of an executor before this one.
void ExecutorNode::on_heartbeat(const Heartbeat& heartbeat) {
  map_watch_.add(heartbeat, bus_.received());
  if (executor_) return;
  const auto requests = heartbeat.channels.find(channels::kHorizonRequest.name);
  if (requests != heartbeat.channels.end() && requests->second.received > 0) has_flown_ = true;
}

void ExecutorNode::on_state(const UavState& state) {
  inputs_.add_state(state.at, bus_.received());
  measured_yaw_ = state.yaw;
  measured_ = state.motion.p;
  on_estimate_shift(resets_.add(state, bus_.received()));
  if (!lost_.empty()) return;
  executor_ ? check_tracking(state) : wait_until_stationary(state);
}

void ExecutorNode::wait_until_stationary(const UavState& state) {
  if (!(state.motion.v.norm() <= kStationarySpeed)) {
    stationary_since_.reset();
    return;
  }
  if (!stationary_since_) stationary_since_ = state.at;
  if (state.at - *stationary_since_ < kStationaryFor) return;
  const bool must_check = status_.following || !refused_start_.empty();
  const auto refusal = must_check ? guard_.check_start(measured_, uav_.start, has_flown_) : std::nullopt;
  if (refusal) return refuse_start(*refusal);
  refused_start_.clear();
  begin(state);
}

void ExecutorNode::check_tracking(const UavState& state) {
  fall_silent_if_held_up(bus_.received());
  if (silent_since_ && state.at < *silent_since_) return;
  if (state.at < last_setpoint_ - kRemembered) return;
  const bool after_silence = silent_since_.has_value();
  const FollowWatch::Judgement judgement = watch_.judge({.measured = state.motion,
                                                         .committed = executor_->sample(state.at),
                                                         .tube = executor_->tube_at(state.at),
                                                         .after_silence = after_silence,
                                                         .follows = following_,
                                                         .reports_following = status_.following},
                                                        bus_.received());
  if (judgement.answer == Following::Unsure) return;
  silent_since_.reset();
  if (judgement.answer == Following::Departed) rejoin(state, true);
  if (after_silence) last_setpoint_ = std::max(last_setpoint_, bus_.received());
  act_on(judgement, state);
}

void ExecutorNode::act_on(const FollowWatch::Judgement& judgement, const UavState& state) {
  const Following answer = judgement.answer;
  if (answer == Following::Departed || answer == Following::OldMessages) return;
  if (answer == Following::Carried || answer == Following::Held) {
    if (!has_followed_) tube_.note_error(judgement.error);
    if (answer == Following::Carried) rejoin(state, false);
    return;
  }
  const bool lost = answer == Following::Lost;
  if (!lost) tube_.add(judgement.error, executor_->at_rest(state.at - kSettled), state.at);
  if (judgement.outside) tube_.add_exit(state.at);
  if (judgement.leaves) {
    const Vec3& error = judgement.error;
    log::warn("the vehicle is ({:.2f}, {:.2f}, {:.2f}) m off its setpoint, outside its tube; {} times so far",
              error.x(), error.y(), error.z(), watch_.exits());
  }
  if (lost) rejoin(state, true);
}

void ExecutorNode::fall_silent_if_held_up(UTime now) {
  if (!silent_since_ && now - last_setpoint_ > kSetpointSilence) fall_silent(now);
}

void ExecutorNode::fall_silent(UTime now) {
  silent_since_ = now;
  drop_unsent_plan();
}

void ExecutorNode::drop_unsent_plan() {
  const UTime start = executor_->committed().newest_start();
  if (!executor_->drop_unsent_plan(last_setpoint_)) return;
  heading_.drop_from(start);
  log::info("dropped the newest plan: no request has reported it to the vehicle");
}

void ExecutorNode::on_estimate_shift(const std::optional<Vec3>& by) {
  if (!by || !has_followed_) return;  // before the first flight, a shift moves the frame W with it
  tube_.add_shift(*by);
  log::warn("the estimator has shifted the vehicle by ({:.2f}, {:.2f}, {:.2f}) m", by->x(), by->y(), by->z());
  if (!executor_ || !lost_.empty() || !is_commanded()) return;
  if (const auto refusal = guard_.check_reset(*by, bus_.received())) lose(*refusal);
}

void ExecutorNode::update_tube(UTime now) {
  executor_->set_tube(tube_.width(sigma_, now), tube_.share());
  log_smallest_tube(tube_.floor_m(), std::exchange(logged_floor_m_, tube_.floor_m()));
}

/// While the vehicle does not follow, somebody else may fly it anywhere.
void ExecutorNode::rejoin(const UavState& state, bool counts) {
  const Vec3 commanded = executor_->sample(state.at).p;
  const auto refusal = is_commanded() ? guard_.check_rejoin(commanded, state.motion.p, counts, state.at) : std::nullopt;
  if (refusal) return lose(*refusal);
  UavState from = state;
  if (state.at <= last_setpoint_) {  // a published setpoint stays: carry the state on to just after it
    from.at = last_setpoint_ + Duration{1};
    const double later_s = (from.at - state.at).seconds();
    from.motion.p += later_s * (state.motion.v + 0.5 * later_s * state.motion.a);
    from.motion.v += later_s * state.motion.a;
  }
  executor_->rejoin(from);
  heading_.clear();
  last_setpoint_ = from.at;
  if (!is_commanded()) return;
  Box flown;
  const ClampedSpline spline = executor_->committed().in_force_at(from.at).spline();
  for (int j = 0; j < spline.intervals(); ++j) flown.extend(spline.position_bounds(j));
  guard_.add_excursion(flown);
}

void ExecutorNode::lose(const std::string& why) {
  lost_ = why;
  log::error("{}; no setpoints are sent any more", why);
  following_ = false;
  stop_following();
}

void ExecutorNode::begin(const UavState& state) {
  const Vec3& p = state.motion.p;
  executor_.emplace(uav_, state, config_);
  heading_.clear();
  update_tube(state.at);
  use_goal();
  if (following_) executor_->begin(bus_.clock().now());
  began_following_ = following_;
  has_flown_ = has_flown_ || following_;
  yaw_follower_.emplace(state.yaw, state.at, config_.heading);
  publish_setpoint(state.at);
  log::info("begins with the vehicle at ({:.2f}, {:.2f}, {:.2f}) m", p.x(), p.y(), p.z());
}

void ExecutorNode::on_status(const VehicleStatus& status) {
  inputs_.add_status(status.at, bus_.received());
  sigma_ = status.position_sigma;
  on_estimate_shift(resets_.add(status.resets, bus_.received()));
  if (!status.mode.empty() && status.mode != kPerfectMode) tube_.assume_errors();
  if (status_.following && !status.following) left_at_ = status.at;
  if (!status_.following && status.following && left_at_) tube_.forget_since(*left_at_ - kNoticed);
  status_ = status;
  update_following(bus_.clock().now());
}

std::string ExecutorNode::reason_not_to_follow(UTime now) const {
  if (!lost_.empty()) return lost_;
  if (is_left()) return status_.why_not;
  if (const auto trouble = inputs_.trouble(now)) return trouble->first + " is " + trouble->second;
  if (following_ || !executor_) return "";
  return guard_.check_start(measured_, uav_.start, has_flown_).value_or("");
}

void ExecutorNode::update_following(UTime now) {
  if (inputs_.usable(now)) {
    counters_at_loss_.reset();
  } else if (!counters_at_loss_) {
    counters_at_loss_ = bus_.counters();
  }
  const std::string why_not = reason_not_to_follow(now);
  if (executor_ && !has_flown_ && status_.following && inputs_.usable(now) && !why_not.empty())
    return refuse_start(why_not);
  if (why_not.empty() == following_) return;
  following_ = !following_;
  log::info("the vehicle {}", following_ ? "follows" : "does not follow: " + why_not);
  if (!executor_) return;
  following_ ? start_following(now) : stop_following();
}

void ExecutorNode::refuse_start(const std::string& why) {
  if (refused_start_.empty()) log::error("does not start: {}", why);
  refused_start_ = why;
  executor_.reset();
  stationary_since_.reset();
}

void ExecutorNode::start_following(UTime now) {
  const bool again = std::exchange(has_followed_, true) || began_following_;
  has_flown_ = true;
  if (again) {
    fall_silent(now);
  } else {
    yaw_follower_.emplace(measured_yaw_, last_setpoint_, config_.heading);
  }
  update_tube(status_.at);
  executor_->begin(now);
}

void ExecutorNode::stop_following() {
  executor_->pause();
  drop_unsent_plan();
  log_counters(executor_->counters(), heading_.counters());
}

void ExecutorNode::on_goal(const Goal& goal) {
  if (goal_ && goal.id == goal_->id && !same_goal(goal, *goal_)) {
    bus_.refuse(channels::kGoal, Rejection::Inconsistent);
    refused_goal_ = {goal.id, bus_.clock().now()};
  }
  if (goal_ && goal.id <= goal_->id) return;
  log::info("goal {}: mode {}, ({:.2f}, {:.2f}, {:.2f}) m", goal.id, to_string(goal.mode), goal.position.x(),
            goal.position.y(), goal.position.z());
  goal_ = goal;
  speed_limit_ = next_speed_limit_ && next_speed_limit_->goal_id == goal.id ? next_speed_limit_ : std::nullopt;
  next_goal_ = bus_.clock().now();
  use_goal();
}

void ExecutorNode::on_speed_limit(const SpeedLimit& limit) {
  if (goal_ && limit.goal_id < goal_->id) return;
  const bool is_of_a_goal_to_come = !goal_ || limit.goal_id > goal_->id;
  (is_of_a_goal_to_come ? next_speed_limit_ : speed_limit_) = limit;
  use_goal();
}

void ExecutorNode::on_plan(const Plan& plan) {
  if (!executor_) return;
  const UTime now = bus_.clock().now();
  const Adoption adoption = executor_->consider(plan, now);
  if (adoption.verdict == Verdict::Adopted) heading_.on_adopted(plan, plan.trajectory.start);
  if (adoption.verdict == Verdict::Kept && plan.request_id == asked_.first) heading_.on_kept(plan, asked_.second);
  if (!is_refusal(adoption.verdict)) return tube_.on_answer(plan, executor_->at_rest(now), now);
  if (adoption.verdict == Verdict::Late || adoption.verdict == Verdict::TooLate) bus_.count_late(channels::kPlan);
  ++unlogged_refusals_;
  if (now < next_refusal_log_) return;
  log::warn("refused the plan for request {}: {} ({}); {} refused since the last such line", plan.request_id,
            to_string(adoption), adoption.detail, unlogged_refusals_);
  unlogged_refusals_ = 0;
  next_refusal_log_ = now + kRefusalLogPeriod;
}

void ExecutorNode::on_heading(const PlanHeading& heading) {
  if (!executor_) return;
  const UTime now = bus_.clock().now();
  const HeadingAdoption adoption = heading_.consider(heading, now);
  if (adoption.verdict == HeadingVerdict::Adopted) return;
  if (adoption.verdict == HeadingVerdict::Late) bus_.count_late(channels::kPlanHeading);
  if (now < next_heading_log_) return;
  next_heading_log_ = now + kRefusalLogPeriod;
  log::warn("refused the heading for request {}: {} ({}); the yaw follows the flight", heading.request_id,
            to_string(adoption.verdict), adoption.detail);
}

void ExecutorNode::use_goal() {
  const bool is_map_kept = map_watch_.judge(bus_.clock().now());
  if (!executor_) return;
  if (goal_) executor_->set_mode(is_map_kept ? goal_->mode : GoalMode::Stop);
  executor_->set_speed_limit(speed_limit_ ? std::optional(speed_limit_->v_max) : std::nullopt);
}

UTime ExecutorNode::next_wakeup() const {
  UTime next = goal_ ? next_goal_ : kNever;
  if (!executor_ || !lost_.empty()) return next;
  if (following_) next = std::min(next, inputs_.usable_until() + Duration{1});
  const auto request = silent_since_ ? std::nullopt : executor_->next_wakeup();
  return std::min({next, next_setpoint_, request.value_or(kNever)});
}

void ExecutorNode::step(UTime now) {
  update_following(now);
  use_goal();
  if (executor_ && lost_.empty()) {
    fall_silent_if_held_up(now);
    const auto due = silent_since_ ? std::nullopt : executor_->next_wakeup();
    if (due && now >= *due) update_tube(now);
    const auto request = silent_since_ ? std::nullopt : executor_->next_request(now);
    if (request) {
      bus_.publish(channels::kHorizonRequest, *request);
      asked_ = {request->id, request->t_s};
    }
    if (!executor_->requests_plans()) drop_unsent_plan();
    if (now >= next_setpoint_) {
      if (!silent_since_) publish_setpoints(now);
      executor_->forget_before(now - kRemembered);
      heading_.forget_before(now - kRemembered);
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
    if (!lost_.empty()) return;
  }
}

void ExecutorNode::publish_setpoint(UTime at) {
  UavState setpoint;
  setpoint.at = at;
  setpoint.motion = executor_->sample_after(at);
  if (is_commanded() && !guard_.may_command(setpoint.motion.p)) {
    return lose("the committed trajectory leaves uav.flight_box by too much");
  }
  const auto planned = heading_.sample(at);
  setpoint.yaw =
      planned ? yaw_follower_->follow(*planned, at, heading_.limits()) : yaw_follower_->follow(setpoint.motion.v, at);
  bus_.publish(channels::kSetpoint, setpoint);
  last_setpoint_ = at;
}

/// How an input that is not usable was refused since then: " (refused: number)"; empty if it was not.
std::string ExecutorNode::refusal_text() const {
  const auto trouble = inputs_.trouble(bus_.clock().now());
  if (!trouble || !counters_at_loss_) return "";
  const auto counters = bus_.counters();
  const auto before = counters_at_loss_->find(trouble->first), after = counters.find(trouble->first);
  if (after == counters.end()) return "";
  for (int k = 0; k < kRejections; ++k) {
    const std::int64_t earlier = before == counters_at_loss_->end() ? 0 : before->second.rejected[k];
    if (after->second.rejected[k] > earlier) {
      return fmt::format(" (refused: {})", to_string(static_cast<Rejection>(k)));
    }
  }
  return "";
}

NodeHealth ExecutorNode::health() const {
  const UTime now = bus_.clock().now();
  if (!lost_.empty()) return {ProcessState::Failed, lost_};
  if (!refused_start_.empty()) return {ProcessState::Waiting, refused_start_};
  if (!executor_) return {ProcessState::Waiting, "a vehicle at rest (UAV_STATE)" + refusal_text()};
  if (!following_ && !is_left()) return {ProcessState::Waiting, reason_not_to_follow(now) + refusal_text()};
  if (const std::string why = map_watch_.trouble(now); !why.empty()) return {ProcessState::Waiting, why};
  if (refused_goal_ && now - refused_goal_->second < kGoalRefusedReported) {
    return {ProcessState::Ready,
            fmt::format("refused a goal: its id {} is in use for another one", refused_goal_->first)};
  }
  return {ProcessState::Ready, ""};
}

}  // namespace tern
