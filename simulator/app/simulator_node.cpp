#include "simulator/app/simulator_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/scenario/obstacle_names.h"
#include "core/world/box_cover.h"
#include "core/world/names.h"
#include "core/world/stated_bound.h"
#include "executor/commanded_motion.h"
#include "messages/codec.h"
#include "runtime/log.h"
#include "runtime/tick.h"
#include "runtime/timed_scenario.h"
#include "simulator/vehicle/external_vehicle.h"

namespace tern {
namespace {

constexpr Duration kStatePeriod{10'000};
constexpr Duration kStatusPeriod{100'000};
constexpr Duration kGoalPeriod{1'000'000};
/// After a pause longer than this, the vehicle has lost setpoints, or receives them too late to fly them.
constexpr Duration kMaxStepGap{400'000};
/// After such a pause the vehicle ignores setpoints for this long. UAV_STATE is published several times in it.
constexpr Duration kResumeDelay{50'000};
/// A message of this process has come back within this time, or is lost.
constexpr Duration kEcho{300'000};
constexpr Duration kResultPeriod{200'000};
constexpr int kResults = 6;
constexpr Duration kCountdown{300'000}, kAtOnce{1'000};
/// An external vehicle's truth may be this late at the end of a flight's time.
constexpr Duration kTruthLate{1'000'000};
constexpr const char* kMapperProcess = "tern-mapper";

UTime whole_ms(UTime t) { return {(t.us + 999) / 1'000 * 1'000}; }

Goal scenario_goal(const Scenario& scenario, bool external) {
  Goal goal;
  goal.id = external ? 2 : 1;  // held() has the id before it
  goal.position = scenario.uav.goal;
  return goal;
}

/// The goal of an external vehicle before world zero. The planner needs a goal, but the vehicle must not fly there yet.
Goal held(Goal goal) {
  goal.id -= 1;
  goal.mode = GoalMode::Hold;
  return goal;
}

}  // namespace

SimulatorNode::SimulatorNode(Bus& bus, const Scenario& scenario, World world, std::unique_ptr<Vehicle> vehicle,
                             const SimulatorConfig& config)
    : bus_(bus),
      config_(config),
      timeout_s_(flight_timeout_s(timed(scenario, config.goals_from))),
      gate_(config.wait_for, bus.epoch_us(), config.max_clock_skew),
      begun_(bus.clock().now()),
      give_up_at_(begun_ + config.wait),
      vehicle_(std::move(vehicle)),
      referee_(timed(scenario, config.goals_from), std::move(world), vehicle_->judged_limits()),
      broadcast_(bus, referee_.world(), config, bus.clock().now()),
      sensors_(bus, config, bus.clock().now()),
      last_step_(bus.clock().now()),
      next_state_(last_step_),
      next_truth_(next_state_),
      next_goal_(next_state_),
      next_status_(next_state_) {
  needs_map_ = std::find(config.wait_for.begin(), config.wait_for.end(), kMapperProcess) != config.wait_for.end();
  referee_.set_earliest_arrival(config.goals_from.empty() ? config.min_flight_s : timeout_s_);
  referee_.set_goal(std::nullopt);
  if (Navigation* navigation = vehicle_->navigation()) {
    vio_.emplace(bus, referee_.world(), scenario, *config.vio, *navigation);
  }
  if (config.send_goal) take_goal(scenario_goal(scenario, config.external));
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) { on_map(chunk); });
  bus_.subscribe(channels::kSetpoint, [this](const UavState& setpoint) {
    const UTime now = bus_.received();
    setpoint_ = setpoint.motion;
    if (!has_missed_setpoints(now) && now >= resumes_at_) vehicle_->receive(setpoint);
  });
  bus_.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& m) { vehicle_->receive(m.committed); });
  bus_.subscribe(channels::kPlan, [this](const Plan& plan) { vehicle_->receive(plan); });
  if (config.external) {
    subscribe_to_external_vehicle();
    referee_.trust_stated_velocities();
  }
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) {
    const bool is_own = status.header.name.sender_epoch_us == bus_.epoch_us();
    if (is_own && catching_up_since_ && status.at >= *catching_up_since_) catching_up_since_.reset();
  });
  bus_.subscribe(channels::kHeartbeat, [this](const Heartbeat& heartbeat) { on_heartbeat(heartbeat); });
}

std::vector<std::string> SimulatorNode::notes() const {
  std::vector<std::string> notes;
  for (const WorldObstacle& obstacle : referee_.world().obstacles) {
    if (const std::string& name = obstacle.spec().name; !name.empty()) notes.push_back(name_note(obstacle.id(), name));
  }
  return notes;
}

UTime SimulatorNode::next_wakeup() const {
  return std::min(
      {next_state_, next_goal_, next_status_, next_result_, broadcast_.next_wakeup(), sensors_.next_wakeup()});
}

void SimulatorNode::subscribe_to_external_vehicle() {
  auto& external = dynamic_cast<ExternalVehicle&>(*vehicle_);
  bus_.subscribe(channels::kVehicleTruth, [&external](const UavState& state) { external.receive_truth(state); });
  bus_.subscribe(channels::kUavState, [&external](const UavState& state) { external.receive_estimate(state); });
}

bool SimulatorNode::has_missed_setpoints(UTime now) const { return now - last_step_ > kMaxStepGap; }

bool SimulatorNode::is_catching_up(UTime now) {
  if (now - last_step_ > kSetpointSilence) catching_up_since_ = next_status_ = now;
  if (has_missed_setpoints(now)) resumes_at_ = now + kResumeDelay;
  if (catching_up_since_ && now - *catching_up_since_ >= kEcho) catching_up_since_.reset();
  last_step_ = now;
  return catching_up_since_.has_value();
}

void SimulatorNode::step(UTime now) {
  const bool behind = is_catching_up(now) && !config_.external;
  if (!world_zero_ && !result_) wait_for_processes(now);
  const bool due = now >= next_state_;
  const bool beat = due && !behind;
  if (beat) vehicle_->advance(now);
  if (beat && vio_) vio_->publish(world_zero_);
  admit(now);
  if (beat) {
    if (!config_.external) publish_state(now);
    judge(now);
  }
  if (due) next_state_ = next_tick(next_state_, kStatePeriod, now);
  broadcast_.step(now, vehicle_->truth(), vehicle_->navigation());
  sensors_.step(now, *vehicle_, [this](UTime t) -> const World& { return broadcast_.world_at(t); });
  if (now >= next_status_) config_.external ? void(next_status_ = kNever) : publish_status(now);
  if (now >= next_goal_) {
    // Plans refer to the first GOAL, so the log must contain it.
    const bool is_kept = world_zero_ || gate_.records(now);
    if (goal_ && is_kept) bus_.publish(channels::kGoal, config_.external && !has_begun(now) ? held(*goal_) : *goal_);
    next_goal_ = next_tick(next_goal_, is_kept ? kGoalPeriod : kStatePeriod, now);
    if (world_zero_ && now < *world_zero_) next_goal_ = std::min(next_goal_, *world_zero_);
  }
  if (now >= next_result_) {
    if (results_left_ > 0) bus_.publish(channels::kFlightResult, *result_);
    next_result_ = --results_left_ < 0 ? kNever : next_tick(next_result_, kResultPeriod, now);
  }
}

std::string SimulatorNode::missing(UTime now) const {
  std::string missing = gate_.missing(now);
  if (!missing.empty() || !needs_map_) return missing;
  return map_progress_.missing() + ", for the referee";
}

void SimulatorNode::wait_for_processes(UTime now) {
  const std::string missing = this->missing(now);
  if (missing.empty()) {
    // A vehicle that others both move and command may depart at once, so its flight begins at once.
    const bool may_depart = config_.external && !config_.send_goal;
    world_zero_ = whole_ms(now + (may_depart ? kAtOnce : config_.declare ? kCountdown : kLookAroundTime));
    next_status_ = std::min(next_status_, *world_zero_);
    broadcast_.start(*world_zero_, now);
    sensors_.start(*world_zero_, now);
    log::info("all processes are ready: world time starts in {} ms", (*world_zero_ - now).us / 1'000);
    const double from_s = config_.declare ? 0.0 : -kLookAroundTime.seconds();
    for (const std::string& name : referee_.passing_the_start(from_s)) {
      log::warn("{} passes through the waiting vehicle: contacts count from world time 0", name);
    }
    if (const std::string clocks = gate_.clocks(); !clocks.empty()) {
      log::info("clock differences from the vehicle: {}", clocks);
    }
  } else if (now >= give_up_at_) {
    FlightResult result = referee_.result_so_far();
    result.detail = fmt::format("not ready after {} s: {}", (give_up_at_ - begun_).us / 1'000'000, missing);
    end_flight(result, kExitNotReady, now);
  }
}

void SimulatorNode::on_heartbeat(const Heartbeat& heartbeat) {
  gate_.receive(heartbeat, bus_.received());
  const std::string skewed = gate_.skewed();
  if (!skewed.empty() && !logged_skewed_) log::error("{}", skewed);
  logged_skewed_ = !skewed.empty();
  if (heartbeat.process == config_.goals_from) obey(heartbeat);
}

/// The process that sends the goals says whether the last one has come.
void SimulatorNode::obey(const Heartbeat& heartbeat) {
  if (!has_begun(bus_.received()) || result_) return;
  if (heartbeat.state == ProcessState::Finished) referee_.set_earliest_arrival(config_.min_flight_s);
  if (heartbeat.state != ProcessState::Failed) return;
  FlightResult result = referee_.result_so_far();
  result.outcome = FlightOutcome::Timeout;
  result.detail = heartbeat.waiting_for;
  end_flight(result, 0, bus_.received());
}

void SimulatorNode::on_map(const MapChunk& chunk) {
  const Result<bool> complete = map_.add(chunk);
  if (!complete) return log::error("map {:016x}: {}", chunk.version, complete.error().message);
  map_progress_.add(chunk);
  give_up_at_ = std::max(give_up_at_, begun_ + config_.wait + map_progress_.rotation() * 2);
  if (!*complete) return;
  std::vector<Box> occupied = cover_with_boxes(map_.take(), false);
  sensors_.set_map(occupied);
  if (const auto taken = referee_.set_map(occupied); !taken) {
    return log::error("map {:016x} is not judged: {}", chunk.version, taken.error().message);
  }
  needs_map_ = false;
}

void SimulatorNode::on_goal(const Goal& goal) {
  if (goal_ && goal.id <= goal_->id) return;
  log::info("goal {}: mode {}, ({:.2f}, {:.2f}, {:.2f}) m", goal.id, static_cast<int>(goal.mode), goal.position.x(),
            goal.position.y(), goal.position.z());
  take_goal(goal);
}

void SimulatorNode::take_goal(const Goal& goal) {
  goal_ = goal;
  if (result_) return;
  referee_.set_goal(goal.mode == GoalMode::Go ? std::optional<Vec3>(goal.position) : std::nullopt);
}

void SimulatorNode::publish_state(UTime now) {
  bus_.publish(channels::kUavState, vehicle_->estimate(now));
  UavState truth = vehicle_->true_state();
  const UTime end = std::min(now, truth.at);
  for (; next_truth_ <= end; next_truth_ = next_truth_ + kStatePeriod) {
    truth.at = next_truth_;
    truth.motion = vehicle_->truth().sample(next_truth_);
    bus_.publish(channels::kVehicleTruth, truth);
  }
}

bool SimulatorNode::has_begun(UTime now) const { return world_zero_ && now >= *world_zero_; }

std::string SimulatorNode::why_not_flying(UTime now) const {
  if (result_) return "the flight has ended";
  if (!world_zero_ || now < *world_zero_) return "world time has not begun";
  if (now < resumes_at_) return "the simulator was held up";
  return "";
}

void SimulatorNode::publish_status(UTime now) {
  VehicleStatus status = vehicle_->status(now);
  if (const std::string why = why_not_flying(now); !why.empty()) {
    status.following = false;
    status.why_not = why;
  }
  bus_.publish(channels::kVehicleStatus, status);
  next_status_ = next_tick(next_status_, kStatusPeriod, now);
  if (world_zero_ && now < *world_zero_) next_status_ = std::min(next_status_, *world_zero_);
  if (now < resumes_at_) next_status_ = std::min(next_status_, resumes_at_);
}

void SimulatorNode::admit(UTime now) {
  if (!world_zero_ || now < *world_zero_) return;
  const MotionHistory& flown = vehicle_->truth();
  referee_.admit((std::max(now, judged_until(now)) - *world_zero_).seconds(), [&](double t_s) {
    return flown.sample(std::min(*world_zero_ + Duration::from_seconds(t_s), flown.end())).p;
  });
}

/// The pieces between an external vehicle's states are judged whole, since their ends have its own velocities.
UTime SimulatorNode::judged_until(UTime now) const {
  return config_.external ? vehicle_->truth().end() : std::min(now, vehicle_->truth().end());
}

void SimulatorNode::judge(UTime now) {
  if (!world_zero_ || result_) return;
  const UTime from = *world_zero_ + referee_.now();
  const UTime to = judged_until(now);
  if (to <= from) return end_without_truth(now);
  for (const CubicPiece& piece : vehicle_->truth().pieces(from, to).pieces) referee_.advance(referee_.now(), piece);
  if (const auto verdict = referee_.verdict()) return end_flight(*verdict, 0, now);
  if (vio_) judge_belief(now);
}

/// The referee has not seen the vehicle arrive.
void SimulatorNode::judge_belief(UTime now) {
  const Navigation& navigation = *vehicle_->navigation();
  const bool may_arrive = goal_ && goal_->mode == GoalMode::Go && navigation.trouble().empty() &&
                          referee_.now().seconds() >= referee_.earliest_arrival_s();
  if (!may_arrive) return believed_arrival_.reset();
  const MotionSample believed = vehicle_->estimate(now).motion;
  if (!believed_arrival_.update(now, goal_->position, setpoint_, believed, navigation.outstanding())) return;
  FlightResult result = referee_.result_so_far();
  result.outcome = FlightOutcome::Timeout;
  result.detail = fmt::format(
      "{}: {:.2f} m from the goal by its own estimate, {:.2f} m in truth; the stated 99 % bound is {:.2f} m",
      kReachedAsBelieved, (believed.p - goal_->position).norm(),
      (vehicle_->true_state().motion.p - goal_->position).norm(), stated_bound(navigation.odometry()->pose_covariance));
  end_flight(result, 0, now);
}

/// The referee's time follows the vehicle's truth. If that ceases, the flight ends when its time is over all the same.
void SimulatorNode::end_without_truth(UTime now) {
  if (!config_.external || (now - *world_zero_).seconds() < timeout_s_ + kTruthLate.seconds()) return;
  FlightResult result = referee_.result_so_far();
  result.outcome = FlightOutcome::Timeout;
  result.detail = fmt::format("no arrival within {:g} s; the vehicle's position was last received at {:.1f} s",
                              timeout_s_, referee_.now().seconds());
  end_flight(result, 0, now);
}

void SimulatorNode::end_flight(const FlightResult& result, int exit_code, UTime now) {
  result_ = result;
  exit_code_ = exit_code;
  results_left_ = kResults;
  next_result_ = next_status_ = now;
  log::info("flight ended: {} {} after {:.2f} s", to_string(result_->outcome), result_->detail, result_->flight_time_s);
}

NodeHealth SimulatorNode::health() const {
  if (result_) return {exit_code_ == 0 ? ProcessState::Finished : ProcessState::Failed, ""};
  if (!world_zero_) return {ProcessState::Waiting, missing(bus_.clock().now())};
  if (!goal_) return {ProcessState::Waiting, "a goal"};
  if (const std::string skewed = gate_.skewed(); !skewed.empty()) return {ProcessState::Waiting, skewed};
  std::string words = broadcast_.trouble();
  for (const std::string& remark : referee_.world().remarks) words += (words.empty() ? "" : "; ") + remark;
  return {ProcessState::Ready, words};
}

std::optional<int> SimulatorNode::finished() const {
  if (result_ && results_left_ < 0) return exit_code_;
  return std::nullopt;
}

}  // namespace tern
