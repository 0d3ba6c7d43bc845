// tern-executor: asks for plans, adopts them, and says setpoint by setpoint what the vehicle shall fly.
#pragma once

#include <cstdint>
#include <optional>

#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/scenario.h"
#include "core/world/vehicle_status.h"
#include "executor/estimate_resets.h"
#include "executor/executor.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// A vehicle that is outside its tube, but by no more than this, is left to its controller, m. While it does not
/// follow, it may be so far off.
inline constexpr double kRejoinBeyond = 0.1;

/// Hears UAV_STATE, VEHICLE_STATUS, GOAL and PLAN; says HORIZON_REQUEST, SETPOINT and, at 1 Hz, the GOAL that it has
/// taken.
///
/// It begins when the vehicle is still, which it is at a flight's start. An executor that was started anew in flight
/// knows nothing of what was committed, and begins when the vehicle has flown that to its end. Then it commits to rest
/// where the vehicle is. It asks for plans while VEHICLE_STATUS says that the vehicle is following and there is a goal.
///
/// It may be held up for longer than kSetpointSilence, or be told that the vehicle follows again. Then it says nothing
/// before it has seen where the vehicle is, which may not have heard of what was adopted last. Who is not where he was
/// committed to be gets a trajectory to rest from where he is.
///
/// The heading begins where it is measured when the vehicle first follows: estimators correct it while they take off.
///
/// UAV_STATE against what is committed makes the tube that requests promise. A vehicle that leaves what was promised,
/// by two states in turn, widens it, which is said. Beyond kRejoinBeyond it gets a trajectory to rest from where it is,
/// from which the next plan goes on.
class ExecutorNode final : public Node {
 public:
  ExecutorNode(Bus& bus, const UavSpec& uav, const ExecutorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

  /// nullptr until the vehicle was found at rest.
  [[nodiscard]] const Executor* executor() const { return executor_ ? &*executor_ : nullptr; }
  /// How often the vehicle has left its tube.
  [[nodiscard]] std::int64_t tube_exits() const { return tube_exits_; }
  /// All zero until then.
  [[nodiscard]] ExecutorCounters counters() const { return executor_ ? executor_->counters() : ExecutorCounters(); }

 private:
  void on_state(const UavState& state);
  void on_status(const VehicleStatus& status);
  void on_goal(const Goal& goal);
  void on_plan(const Plan& plan);
  void wait_until_stationary(const UavState& state);
  void begin(const UavState& state);
  void check_tracking(const UavState& state);
  void rejoin(const UavState& state);
  /// Without a step for kSetpointSilence: a plan may have been adopted of which the vehicle has not heard.
  void fall_silent_if_held_up(UTime now);
  void fall_silent(UTime now);
  /// What could not be told is not flown, or the vehicle would be elsewhere.
  void drop_unsent_plan();
  /// The first state since the vehicle and what is committed may have parted. @return whether they have
  bool check_after_silence(const UavState& state, const Vec3& error);
  void on_estimate_shift(const std::optional<Vec3>& by);
  void update_tube(UTime now);
  void publish_setpoints(UTime now);
  void publish_setpoint(UTime at);
  void log_counters() const;

  Bus& bus_;
  UavSpec uav_;
  ExecutorConfig config_;
  std::optional<Executor> executor_;
  std::optional<UTime> stationary_since_;
  std::optional<Goal> goal_;
  bool following_ = false, has_followed_ = false;
  std::optional<UTime> silent_since_;  ///< nothing is said until a state of this time or later has come
  Tube tube_;
  EstimateResets resets_;
  Vec3 sigma_ = Vec3::Zero();    // of the estimate, m
  std::int64_t tube_exits_ = 0;  // how often the vehicle has left its tube
  bool outside_tube_ = false;
  PersistentError persistent_error_;
  Vec3 excess_ = Vec3::Zero();               ///< of the newest state, what of its error was not promised; m
  double measured_yaw_ = 0.0;                ///< rad, the newest
  std::optional<YawFollower> yaw_follower_;  ///< once the executor has begun
  UTime last_setpoint_;
  UTime next_setpoint_, next_goal_;
  UTime next_refusal_log_;
  std::int64_t unlogged_refusals_ = 0;
};

}  // namespace tern
