// tern-executor: requests plans, adopts them, and publishes the vehicle's setpoints.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/scenario/scenario.h"
#include "core/wire/health.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/vehicle_status.h"
#include "executor/app/live_map_watch.h"
#include "executor/committed_heading.h"
#include "executor/estimate_resets.h"
#include "executor/executor.h"
#include "executor/follow_watch.h"
#include "executor/rejoin_guard.h"
#include "executor/vehicle_inputs.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// Flies plans: requests them, adopts them, and publishes a setpoint at 100 Hz and at each knot of the trajectory.
/// Receives UAV_STATE, VEHICLE_STATUS, GOAL, SPEED_LIMIT, PLAN and PLAN_HEADING; publishes HORIZON_REQUEST, SETPOINT
/// and GOAL.
///
/// | state     | entered when                                                  | publishes      | requests plans    |
/// |-----------|---------------------------------------------------------------|----------------|-------------------|
/// | Waiting   | at start, also after a restart in flight                      | GOAL           | no                |
/// | Holding   | the vehicle is stationary: its position is committed          | SETPOINT, GOAL | no                |
/// | Following | VEHICLE_STATUS reports that the vehicle follows               | SETPOINT, GOAL | unless mode Stop   |
/// | Silent    | no setpoint for kSetpointSilence, or the vehicle follows again | GOAL          | no                |
/// | Lost      | RejoinGuard refuses a rejoin or a reset                       | GOAL           | no                |
///
/// The vehicle follows if VEHICLE_STATUS says so, UAV_STATE and VEHICLE_STATUS are usable (VehicleInputs), and it is
/// inside the flight box. HEARTBEAT says which of these fails.
///
/// The vehicle is stationary at the start of a flight. After a restart in flight it first flies the trajectory that was
/// committed before to its end. GOAL is the goal received last, at 1 Hz.
///
/// | event                                          | state     | effect                                              |
/// |------------------------------------------------|-----------|-----------------------------------------------------|
/// | a UAV_STATE                                    | any       | FollowWatch decides: none, a wider tube, a rejoin   |
/// | first UAV_STATE since the silence began        | Silent    | Silent ends                                         |
/// | the vehicle stops following, or mode Stop      | Following | a plan that no request contained yet is dropped;    |
/// |                                                |           | the committed trajectory is flown to its end        |
/// | a start that RejoinGuard refuses               | Holding   | Waiting, with the reason                            |
/// | a GOAL with the id in use and other contents   | any       | refused and counted as inconsistent                 |
/// | the vehicle follows again                      | Following | the tube forgets the errors from 1 s before it left |
/// | the vehicle follows for the first time         | Holding   | the yaw starts at the measured yaw                  |
/// | the estimator is reset after the first time    | any       | the tube grows by the shift                         |
/// | a PLAN_HEADING that CommittedHeading adopts    | Following | the yaw turns along it, else along the flight       |
/// | a live map is no longer kept (LiveMapWatch)    | any       | as mode Stop, until it is kept again                |
///
/// - A rejoin commits to a braking trajectory from the measured state; the next plan starts on it.
/// - The yaw starts at the measured one because estimators correct it during take-off.
/// - Silent is needed because the vehicle may not have received the plan that was adopted last.
/// - Only a restart ends Lost. Since no setpoint is sent, the vehicle comes to rest at the end of the trajectory that
///   it knows. There its pilot or its own failsafe takes over.
class ExecutorNode final : public Node {
 public:
  ExecutorNode(Bus& bus, const UavSpec& uav, const ExecutorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

  /// nullptr in state Waiting.
  [[nodiscard]] const Executor* executor() const { return executor_ ? &*executor_ : nullptr; }
  /// Number of times that the vehicle has left its tube.
  [[nodiscard]] std::int64_t tube_exits() const { return watch_.exits(); }
  /// The reason of state Lost; empty in the other states.
  [[nodiscard]] const std::string& lost() const { return lost_; }
  /// Of all PLAN_HEADINGs received.
  [[nodiscard]] const HeadingCounters& heading_counters() const { return heading_.counters(); }
  /// All zero in state Waiting.
  [[nodiscard]] ExecutorCounters counters() const { return executor_ ? executor_->counters() : ExecutorCounters(); }

 private:
  void on_state(const UavState& state);
  void on_status(const VehicleStatus& status);
  void on_goal(const Goal& goal);
  void on_speed_limit(const SpeedLimit& limit);
  void on_plan(const Plan& plan);
  void on_heading(const PlanHeading& heading);
  void on_heartbeat(const Heartbeat& heartbeat);
  /// Tells the executor mode and speed limit of the newest goal. While a live map is old (LiveMapWatch), it is Stop.
  void use_goal();
  /// Decides whether the vehicle follows, and acts if that has changed.
  void update_following(UTime now);
  /// Why the vehicle does not follow, in words; empty if it does.
  [[nodiscard]] std::string reason_not_to_follow(UTime now) const;
  [[nodiscard]] std::string refusal_text() const;
  /// Whether the vehicle flies the setpoints, as far as is known: it still does while its messages are too old.
  [[nodiscard]] bool is_commanded() const { return following_ || status_.following; }
  /// Its status says that it does not follow. Before the first status there is no such reason.
  [[nodiscard]] bool is_left() const { return !status_.why_not.empty(); }
  void refuse_start(const std::string& why);
  void start_following(UTime now);
  void stop_following();
  void wait_until_stationary(const UavState& state);
  void begin(const UavState& state);
  void check_tracking(const UavState& state);
  void act_on(const FollowWatch::Judgement& judgement, const UavState& state);
  /// @param counts  whether the shift counts for RejoinGuard
  void rejoin(const UavState& state, bool counts);
  void lose(const std::string& why);
  /// Enters Silent if the newest setpoint is older than kSetpointSilence.
  void fall_silent_if_held_up(UTime now);
  void fall_silent(UTime now);
  /// Drops the newest plan if no request has contained it: the vehicle does not know it, and would be elsewhere.
  void drop_unsent_plan();
  void on_estimate_shift(const std::optional<Vec3>& by);
  void update_tube(UTime now);
  void publish_setpoints(UTime now);
  void publish_setpoint(UTime at);

  Bus& bus_;
  UavSpec uav_;
  ExecutorConfig config_;
  std::optional<Executor> executor_;
  std::optional<UTime> stationary_since_;
  std::optional<Goal> goal_;
  std::optional<SpeedLimit> speed_limit_, next_speed_limit_;  ///< of goal_; of a goal to come
  VehicleInputs inputs_;
  LiveMapWatch map_watch_;
  RejoinGuard guard_;
  VehicleStatus status_;          ///< newest; does not follow before the first
  Vec3 measured_ = Vec3::Zero();  ///< position, newest, m, W
  bool following_ = false, has_followed_ = false, began_following_ = false;
  bool has_flown_ = false;            ///< plans were requested, by this executor or one before it
  std::string refused_start_, lost_;  ///< reasons in words
  std::optional<std::map<std::string, ChannelCounters>> counters_at_loss_;  ///< when an input ceased to be usable
  std::optional<std::pair<std::int64_t, UTime>> refused_goal_;              ///< id, and when
  std::optional<UTime> silent_since_;  ///< set in state Silent: a UAV_STATE of this time or later ends it
  Tube tube_;
  double logged_floor_m_ = tube_.floor_m();
  EstimateResets resets_;
  std::optional<UTime> left_at_;  ///< when VEHICLE_STATUS last reported that the vehicle no longer follows
  Vec3 sigma_ = Vec3::Zero();     ///< standard deviation of the estimate, m
  FollowWatch watch_;
  double measured_yaw_ = 0.0;                ///< rad, newest
  std::optional<YawFollower> yaw_follower_;  ///< empty in state Waiting
  CommittedHeading heading_;
  std::pair<std::int64_t, UTime> asked_{0, {}};  ///< id and t_s of the newest request
  UTime last_setpoint_;
  UTime next_setpoint_, next_goal_;
  UTime next_refusal_log_, next_heading_log_;
  std::int64_t unlogged_refusals_ = 0;
};

}  // namespace tern
