#include "monitor/flight_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/world/body.h"
#include "monitor/flight_cause.h"

namespace tern {
namespace {

/// Modes of the simulator's own vehicles; an autopilot has others, and its clock cannot be slowed.
bool is_simulated(const std::string& mode) { return mode.empty() || mode == kPerfectMode || mode == "quadrotor"; }

}  // namespace

FlightWatch::FlightWatch(const Scenario& scenario, UTime now)
    : scenario_(scenario), goal_(scenario.uav.goal), began_(now), evidence_(scenario.uav.start, scenario.uav.goal) {}

void FlightWatch::receive(const Heartbeat& heartbeat, UTime now) {
  processes_.add(heartbeat, now);
  recording_.receive(heartbeat);
  note(heartbeat);
  beat_ = now;
  const bool of_result = result_ && heartbeat.process == kSimulatorProcess &&
                         heartbeat.header.name.sender_epoch_us == result_->header.name.sender_epoch_us;
  if (of_result && heartbeat.header.utime > result_->header.utime && heartbeat.state == ProcessState::Ready) {
    result_.reset();
  }
}

/// Epoch of the flight's simulator; before the first request, of the active one; 0: none.
std::int64_t FlightWatch::simulator_epoch_us() const {
  return world_epoch_us_ != 0 ? world_epoch_us_ : processes_.epoch_us(kSimulatorProcess);
}

void FlightWatch::receive(const UavState& state) {
  state_ = state;
  if (!result_) estimate_.add_believed(state);
  note(state);
  ledger_.advance(state.header.utime);
}

void FlightWatch::receive(const Goal& goal) {
  note(goal);
  if (goal.mode == GoalMode::Go) goal_ = goal.position;
}

void FlightWatch::receive(const HorizonRequest& request, UTime now) {
  if (ledger_.add(request)) certified_.add(request);
  note(request);
  const bool is_executors = request.header.name.sender_epoch_us == processes_.epoch_us(kExecutorProcess);
  recording_.begin();
  if (world_epoch_us_ != 0 || (first_request_ && !is_executors)) return;
  first_request_ = request;
  first_request_at_ = now;
  if (is_executors) world_epoch_us_ = processes_.epoch_us(kSimulatorProcess);
}

void FlightWatch::receive(const Plan& plan) {
  ledger_.add(plan);
  note(plan);
}

void FlightWatch::receive(const PlanTiming& timing) {
  if (!timings_filter_.is_first(timing.header.name)) return;
  replan_.add(timing);
  note(timing);
}

void FlightWatch::receive(const FlightResult& result, UTime now) {
  if (result_ || result.header.name.sender_epoch_us != simulator_epoch_us()) return;
  result_ = result;
  result_at_ = now;
}

void FlightWatch::fail(std::string detail) {
  if (failure_.empty()) failure_ = std::move(detail);
}

std::optional<std::string> FlightWatch::failure(UTime now) const {
  if (!failure_.empty()) return failure_;
  const UTime last_heartbeat = processes_.last_heartbeat(kSimulatorProcess, simulator_epoch_us()).value_or(began_);
  if (now - last_heartbeat > kSimulatorSilence) {
    return fmt::format("{} sent no heartbeat for {:.0f} s", kSimulatorProcess, (now - last_heartbeat).seconds());
  }
  if (processes_.epoch_us(kSimulatorProcess) != simulator_epoch_us() && now - last_heartbeat > kSuccessorSilence) {
    return fmt::format("{} restarted during the flight: its world is lost", kSimulatorProcess);
  }
  const Duration limit = Duration::from_seconds(flight_timeout_s(scenario_)) + kResultSlack;
  if (first_request_at_ && now - *first_request_at_ > limit) {
    return fmt::format("no FLIGHT_RESULT {:.0f} s after the first request", limit.seconds());
  }
  return std::nullopt;
}

std::optional<Ending> FlightWatch::ending(UTime now) const {
  if (result_) {
    if (now - result_at_ < kLastReports) return std::nullopt;
    return Ending{result_->outcome, result_->detail};
  }
  if (const auto why = failure(now)) return Ending{FlightOutcome::Failed, *why};
  return std::nullopt;
}

double FlightWatch::nearest_obstacle() const {
  double nearest = std::numeric_limits<double>::quiet_NaN();
  const Box body = body_box(scenario_.uav.body);
  for (const TrueObstacle& obstacle : obstacles_) {
    const Box touching = places_at(box_around(obstacle.position, obstacle.half_extents), body);
    nearest = std::fmin(nearest, touching.exteriorDistance(state_->motion.p));
  }
  return nearest;
}

double FlightWatch::nearest_wall() const {
  double nearest = std::numeric_limits<double>::quiet_NaN();
  const Box body = body_box(scenario_.uav.body);
  for (const Box& box : occupied_) {
    nearest = std::fmin(nearest, places_at(box, body).exteriorDistance(state_->motion.p));
  }
  return nearest;
}

LiveView FlightWatch::live() const {
  LiveView view;
  view.waiting = processes_.waiting();
  view.concurrent = processes_.concurrent_now(beat_);
  view.flying = first_request_ && state_;
  if (!view.flying) return view;
  const Vec3& p = state_->motion.p;
  view.elapsed_s = (state_->at - first_request_->header.utime).seconds();
  const double way = (goal_ - scenario_.uav.start).norm();
  view.progress = way > 0.0 ? std::clamp(1.0 - (goal_ - p).norm() / way, 0.0, 1.0) : 1.0;
  view.speed_mps = state_->motion.v.norm();
  view.nearest_m = nearest_obstacle();
  view.nearest_wall_m = nearest_wall();
  const Percentiles replan = percentiles(replan_.total);
  view.replan_p50_ms = replan.p50;
  view.replan_p99_ms = replan.p99;
  view.pace = pace_.value_or(1.0);
  view.requests = ledger_.requests();
  view.answered_in_time = ledger_.answered_in_time();
  view.reason = ledger_.last_reason();
  view.left_out = ledger_.last_left_out();
  return view;
}

FlightSummary FlightWatch::summary(const Ending& ending) const {
  const auto stage = [this](Stage s) { return percentiles(replan_.stage[static_cast<int>(s)]); };
  FlightSummary summary;
  summary.outcome = ending.outcome;
  summary.detail = ending.detail;
  const bool by_autopilot = !is_simulated(evidence_.status().mode);
  summary.explanation =
      explain(evidence_, {ending.outcome, ending.detail, result_, by_autopilot ? std::nullopt : pace_});
  if (recording_.is_recorded()) summary.recording = recording_.gap();
  summary.scenario = scenario_.name;
  summary.seed = scenario_.seed;
  summary.count = scenario_.world.count;
  const SemanticsSpec& semantics = scenario_.semantics;
  summary.settings = {scenario_.uav.limits, semantics.enabled ? semantics.lambda_attractive : 0.0,
                      semantics.enabled ? semantics.lambda_repulsive : 0.0};
  summary.result = result_;
  summary.requests = ledger_.requests();
  summary.answered_in_time = ledger_.answered_in_time();
  summary.second_answers = ledger_.second_answers();
  for (int k = 0; k < kPlanOutcomes; ++k) {
    summary.plans[idx(k)] = ledger_.plans(static_cast<PlanOutcome>(k));
  }
  for (int k = 0; k < kPlanReasons; ++k) {
    summary.reasons[idx(k)] = ledger_.plans(static_cast<PlanReason>(k));
  }
  summary.by_level = ledger_.plans_by_level();
  summary.for_a_time = ledger_.plans_for_a_time();
  summary.left_out = ledger_.left_out();
  if (state_) summary.passively_safe_share = certified_.until(state_->at);
  summary.replan_ms = {percentiles(replan_.total), percentiles(replan_.first_answer), stage(Stage::BroadPhase),
                       stage(Stage::Search),       stage(Stage::Optimization),        stage(Stage::Check)};
  summary.pace = pace_.value_or(1.0);
  summary.messages = processes_.messages();
  summary.restarts = processes_.restarts();
  summary.said = processes_.words();
  summary.concurrent = processes_.concurrent();
  return summary;
}

}  // namespace tern
