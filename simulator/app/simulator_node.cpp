#include "simulator/app/simulator_node.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/world/names.h"
#include "messages/codec.h"
#include "simulator/app/beat.h"

namespace tern {
namespace {

constexpr Duration kStatePeriod{10'000};
constexpr Duration kGoalPeriod{1'000'000};
constexpr Duration kResultPeriod{200'000};
constexpr int kResults = 6;
constexpr Duration kCountdown{300'000};
constexpr Duration kRefusalLogPeriod{1'000'000};
/// The sensor's latency is at most 2 s: frames up to that old ask where the vehicle was.
constexpr Duration kRemembered{3'000'000};
/// Below this the velocity has no direction worth a yaw, m/s.
constexpr double kYawSpeed = 0.05;

UTime whole_ms(UTime t) { return {(t.us + 999) / 1'000 * 1'000}; }

Goal scenario_goal(const Scenario& scenario) {
  Goal goal;
  goal.id = 1;
  goal.position = scenario.uav.goal;
  return goal;
}

}  // namespace

SimulatorNode::SimulatorNode(Bus& bus, const Scenario& scenario, World world, const SimulatorConfig& config,
                             const ExecutorConfig& executor)
    : bus_(bus),
      config_(config),
      gate_(config.wait_for, bus.epoch_us(), config.max_clock_skew),
      give_up_at_(bus.clock().now() + config.wait),
      executor_(scenario.uav, bus.clock().now(), executor),
      referee_(scenario, std::move(world)),
      broadcast_(bus, referee_.world(), config, bus.clock().now()),
      next_state_(bus.clock().now()),
      next_goal_(next_state_),
      next_refusal_log_(next_state_) {
  referee_.set_earliest_arrival(config.min_flight_s);
  referee_.set_goal(std::nullopt);
  if (config.send_goal) take_goal(scenario_goal(scenario));
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kPlan, [this](const Plan& plan) { on_plan(plan); });
  bus_.subscribe(channels::kHeartbeat, [this](const Heartbeat& heartbeat) { on_heartbeat(heartbeat); });
}

UTime SimulatorNode::next_wakeup() const {
  UTime next = std::min({next_state_, next_goal_, next_result_, broadcast_.next_wakeup()});
  return std::min(next, executor_.next_wakeup().value_or(kNever));
}

void SimulatorNode::step(UTime now) {
  ask(now);
  if (!world_zero_ && !result_) wait_for_processes(now);
  broadcast_.step(now, executor_);
  if (now >= next_state_) {
    publish_state(now);
    judge(now);
    next_state_ = next_beat(next_state_, kStatePeriod, now);
  }
  if (now >= next_goal_) {
    // Plans name the GOAL that was heard first: the log must have it.
    const bool is_kept = world_zero_ || gate_.records(now);
    if (goal_ && is_kept) bus_.publish(channels::kGoal, *goal_);
    next_goal_ = next_beat(next_goal_, is_kept ? kGoalPeriod : kStatePeriod, now);
  }
  if (now >= next_result_) {
    if (results_left_ > 0) bus_.publish(channels::kFlightResult, *result_);
    next_result_ = --results_left_ < 0 ? kNever : next_beat(next_result_, kResultPeriod, now);
  }
}

void SimulatorNode::wait_for_processes(UTime now) {
  const std::string missing = gate_.missing(now);
  if (missing.empty()) {
    world_zero_ = whole_ms(now + kCountdown);
    executor_.begin(*world_zero_);
    broadcast_.start(*world_zero_, now);
    spdlog::info("everyone is ready: world time starts in {} ms", (*world_zero_ - now).us / 1'000);
    if (const std::string clocks = gate_.clocks(); !clocks.empty()) {
      spdlog::info("clocks against the vehicle's: {}", clocks);
    }
  } else if (now >= give_up_at_) {
    FlightResult result = referee_.result_so_far();
    result.detail = "not ready after " + std::to_string(config_.wait.us / 1'000'000) + " s: " + missing;
    end_flight(result, kExitNotReady, now);
  }
}

void SimulatorNode::on_heartbeat(const Heartbeat& heartbeat) {
  gate_.hear(heartbeat, bus_.received());
  const std::string skewed = gate_.skewed();
  if (!skewed.empty() && !said_skewed_) spdlog::error("{}", skewed);
  said_skewed_ = !skewed.empty();
}

void SimulatorNode::ask(UTime now) {
  if (const auto request = executor_.next_request(now)) bus_.publish(channels::kHorizonRequest, *request);
}

void SimulatorNode::on_plan(const Plan& plan) {
  const UTime now = bus_.clock().now();
  const Adoption adoption = executor_.consider(plan, now);
  if (!is_refusal(adoption.verdict)) return;
  if (adoption.verdict == Verdict::Late || adoption.verdict == Verdict::TooLate) bus_.count_late(channels::kPlan);
  ++refusals_unsaid_;
  if (now < next_refusal_log_) return;
  spdlog::warn("refused the plan for request {}: {} ({}); {} refused since the last word", plan.request_id,
               to_string(adoption.verdict), adoption.detail, refusals_unsaid_);
  refusals_unsaid_ = 0;
  next_refusal_log_ = now + kRefusalLogPeriod;
}

void SimulatorNode::on_goal(const Goal& goal) {
  if (goal_ && goal.id <= goal_->id) return;
  spdlog::info("goal {}: mode {}, ({:.2f}, {:.2f}, {:.2f}) m", goal.id, static_cast<int>(goal.mode), goal.position.x(),
               goal.position.y(), goal.position.z());
  take_goal(goal);
}

void SimulatorNode::take_goal(const Goal& goal) {
  goal_ = goal;
  if (result_) return;
  executor_.set_mode(goal.mode);
  referee_.set_goal(goal.mode == GoalMode::Go ? std::optional<Vec3>(goal.position) : std::nullopt);
}

void SimulatorNode::publish_state(UTime now) {
  UavState state;
  state.at = now;
  state.motion = executor_.sample(now);
  const Vec3& v = state.motion.v;
  if (v.head<2>().norm() > kYawSpeed) yaw_ = std::atan2(v.y(), v.x());
  state.yaw = yaw_;
  bus_.publish(channels::kUavState, state);
  bus_.publish(channels::kSetpoint, state);
}

void SimulatorNode::judge(UTime now) {
  if (!world_zero_ || result_ || now <= *world_zero_ + referee_.now()) return;
  const UTime from = *world_zero_ + referee_.now();
  for (const CubicPiece& piece : executor_.pieces(from, now).pieces) referee_.advance(referee_.now(), piece);
  executor_.forget_before(now - kRemembered);
  if (const auto verdict = referee_.verdict()) end_flight(*verdict, 0, now);
}

void SimulatorNode::end_flight(const FlightResult& result, int exit_code, UTime now) {
  result_ = result;
  exit_code_ = exit_code;
  results_left_ = kResults;
  next_result_ = now;
  executor_.set_mode(GoalMode::Stop);
  log_end();
}

void SimulatorNode::log_end() const {
  const ExecutorCounters& counters = executor_.counters();
  spdlog::info("flight ended: {} {} after {:.2f} s", to_string(result_->outcome), result_->detail,
               result_->flight_time_s);
  spdlog::info("requests {}, answered in time {}, unanswered {}, late {}, answered twice {}", counters.requests,
               counters.answered_in_time, counters.unanswered, counters.late(), counters.answered_twice());
  for (int k = 0; k < kVerdicts; ++k) {
    const auto verdict = static_cast<Verdict>(k);
    if (counters.of(verdict) > 0) spdlog::info("plans {}: {}", to_string(verdict), counters.of(verdict));
  }
}

NodeHealth SimulatorNode::health() const {
  if (result_) return {exit_code_ == 0 ? ProcessState::Finished : ProcessState::Failed, ""};
  if (!world_zero_) return {ProcessState::Waiting, gate_.missing(bus_.clock().now())};
  if (!goal_) return {ProcessState::Waiting, "a goal"};
  if (const std::string skewed = gate_.skewed(); !skewed.empty()) return {ProcessState::Waiting, skewed};
  return {ProcessState::Ready, broadcast_.trouble()};
}

std::optional<int> SimulatorNode::finished() const {
  if (result_ && results_left_ < 0) return exit_code_;
  return std::nullopt;
}

}  // namespace tern
