// The bridge between SETPOINT and an autopilot: take-off, following, standing back, landing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "executor/commanded_motion.h"
#include "mavlink/autopilot.h"
#include "mavlink/bridge_config.h"
#include "mavlink/faults.h"
#include "mavlink/fed_offset.h"
#include "mavlink/flown_frame.h"
#include "mavlink/mode_arbiter.h"
#include "mavlink/odometry_report.h"
#include "mavlink/outbox.h"
#include "mavlink/parameter_exchange.h"
#include "mavlink/tilt_ramp.h"
#include "mavlink/tracking_report.h"
#include "mavlink/truth_anchor.h"
#include "mavlink/vision_check.h"

namespace tern::mavlink {

/// The stage of a flight. Bridge has the tables of stages and events.
enum class Stage : std::uint8_t {
  Waiting,    ///< link, estimate, clock or parameters are missing
  Ready,      ///< waits for an order to fly, or for the pilot
  Engaging,   ///< requests the following mode, then arming
  Climbing,   ///< from the ground to uav.start
  Following,  ///< flies SETPOINT
  StoodBack,  ///< another pilot flies, until the next order
  Landing,
  Landed
};
const char* to_string(Stage stage);

/// Flies a vehicle with an autopilot (PX4 or ArduPilot). Pure: frames and times in, frames out. The caller sends the
/// frames of take_frames() and calls step() at rate_hz or more.
///
/// W is the autopilot's local frame, shifted: the local origin lies at (uav.start.x, uav.start.y, 0). So a vehicle
/// whose estimator was started where it stands climbs straight up to uav.start.
///
/// *Following mode* is OFFBOARD of PX4, GUIDED of ArduPilot.
///
/// | stage     | entered when                                                  | setpoints to a PX4             |
/// |-----------|---------------------------------------------------------------|--------------------------------|
/// | Waiting   | at start, and after an order in StoodBack or Landed           | none                           |
/// | Ready     | link, clock, estimate and parameters are good                 | stay here                      |
/// | Engaging  | ordered to fly, and setpoints have been sent for 1 s          | stay here                      |
/// | Climbing  | armed in the following mode on the ground                     | up to uav.start at climb_speed |
/// | Following | rests at uav.start, or armed in the following mode in the air | SETPOINT, or stay here         |
/// | StoodBack | another pilot flies                                           | none; start pilot: stay here   |
/// | Landing   | land() while the bridge flies                                 | stay here, until it lands      |
/// | Landed    | disarmed, and no arming request for 1.5 s                     | none                           |
///
/// | event                                                       | stage               | next stage                |
/// |-------------------------------------------------------------|---------------------|---------------------------|
/// | link, clock, estimate or parameters are no longer good      | Ready               | Waiting                   |
/// | the pilot's switch: armed in the following mode             | Ready               | Climbing or Following     |
/// | armed in another mode (start arm, not ordered by GOAL)      | Ready               | StoodBack                 |
/// | mode or arming changed by another sender; no success in 120 s | Engaging          | StoodBack                 |
/// | SETPOINT or the vehicle beyond the last bound               | Following           | Landing                   |
/// | the autopilot leaves the following mode, or disarms         | Climbing, Following | StoodBack                 |
/// | battery below battery_land                                  | Climbing, Following | Landing                   |
/// | the estimate is apart from external vision for 1 s          | Climbing, Following | Landing                   |
/// | FLIGHT_RESULT, or the process ends                          | Engaging, Climbing, Following | Landing         |
/// | the autopilot leaves the landing mode                       | Landing             | StoodBack                 |
/// | order_flight(): a new GOAL (start pilot: once it has followed) | StoodBack, Landed | Waiting                  |
/// | the pilot's switch, start pilot                             | StoodBack           | Waiting                   |
///
/// A restarted bridge passes through Waiting and Ready to Following if the vehicle flies in the following mode. It
/// sends no setpoint in Waiting, so the first one is at the present estimate. The first SETPOINT is its command at
/// once. The vehicle's failsafe begins after COM_OF_LOSS_T. So the bridge requests HEARTBEAT of an unknown autopilot,
/// and reads parameters while it flies.
///
/// SETPOINT is flown while it is received, within far_m of the vehicle, and the estimate is alive. A PX4 must also be
/// past its tilt limit of the take-off (TiltRamp). Otherwise the vehicle is commanded to stop, and VEHICLE_STATUS
/// reports *not following*. With a dead estimate it is to stop at the last setpoint. While the estimate is apart from
/// external vision (VisionCheck), the vehicle is commanded to stay where the autopilot estimates it at each moment. Any
/// other setpoint would move it.
///
/// **Setpoints.** SET_POSITION_TARGET_LOCAL_NED goes out at rate_hz, with p and v of the command, the yaw, and
///
///     acceleration_gain·(a(t + lead) + D·a(t)) + drag_per_s·v(t + lead).
///
/// D is MPC_XY_VEL_D_ACC and MPC_Z_VEL_D_ACC as read: that term of a PX4 opposes the whole present acceleration. The
/// rest is what the vehicle must have when it has tilted, 1/MC_ROLL_P later. A PX4 holds a setpoint for one period, so
/// p and v are those of half a period later. An ArduPilot extrapolates, so p and v are those of now. It integrates the
/// acceleration to the motion that it follows, so its setpoint has a(t). Position, velocity and acceleration are
/// shifted by a FedOffset, which its loops answer with the rest. The bridge also sends HEARTBEAT at 2 Hz, TIMESYNC at
/// 10 Hz, and in flight a request for the autopilot's HEARTBEAT at 5 Hz.
///
/// When a flight with a PX4 ends, the log has drag and lag as measured, and the settings that they ask for. The lines
/// are missing if FlightIdentification has no answer.
///
/// **Parameters.** With set_parameters, those that decide what happens after a loss, and those of the estimator, are
/// written in stage Waiting. Bounds of the vehicle (speed, tilt, rates) are written only with raise_bounds: otherwise
/// the scenario must fit them. All are restored in stage Landed, and when the process ends, if the vehicle is disarmed.
///
/// **HEARTBEAT as a ground station.** A PX4 sends STATUSTEXT, which says why arming is denied, only to a link with a
/// ground station. So the bridge sends a second HEARTBEAT of that type, but only if NAV_DLL_ACT was read as 0. With
/// another value the autopilot acts on the loss of a ground station, and would take this HEARTBEAT for an operator's.
/// An ArduPilot sends STATUSTEXT to every link.
///
/// **A pilot's switch has priority**: ModeArbiter.
///
/// **Failsafe of a PX4.** PX4 returns to OFFBOARD as soon as it receives setpoints, in any failsafe. So no setpoint is
/// sent while the vehicle may be in a failsafe: after a silence of COM_OF_LOSS_T, HEARTBEAT must report the mode first.
/// During a reported failsafe, setpoints are sent only after order_flight().
///
/// **Errors of the estimate** (OdometryReport). With `odometry`, estimate() is Tern's ODOMETRY. States and setpoints
/// are those of a FlownFrame, which follows a reset of the autopilot's estimator slowly. Without a usable ODOMETRY the
/// vehicle reports *not following*. It flies SETPOINT on, which ends at rest, and lands after kOdometryPatience there.
///
/// **Take-off of an ArduPilot.** The bridge sends NAV_TAKEOFF, to uav.start's height above the vehicle's home. A
/// setpoint would end that take-off, so setpoints start when the vehicle is up. If a take-off is already under way, the
/// bridge waits for its end.
class Bridge {
 public:
  /// The last bound is the flight box (of the vehicle's centre), wider by this, m. tern-executor rejoins a vehicle up
  /// to RejoinGuard::kMaxExcursion (2 m) outside, and needs as much to brake.
  static constexpr double kLastBound = 4.0;
  /// A vehicle that rests for this long without an ODOMETRY to fly by lands.
  static constexpr Duration kOdometryPatience{5'000'000};

  Bridge(const BridgeConfig& config, const UavSpec& uav, UTime now);

  void receive(const Frame& frame, UTime received);
  void receive(const UavState& setpoint);
  void receive(const TimedSpline& committed) { command_.receive(committed); }
  void receive(const Plan& plan) { command_.receive(plan); }
  /// Takes the vehicle's state (W) from a motion-capture system. Used only with external_vision.
  void receive_vision(const UavState& seen);
  /// Takes a frame of a companion's estimator: ODOMETRY, TIMESYNC.
  /// @param of_unix  our time of a time since the Unix epoch, µs
  void receive_companion(const Frame& frame, UTime received, const std::function<UTime(std::int64_t)>& of_unix);
  /// A new GOAL of mode Go orders the vehicle to fly. With `start: pilot` only after this bridge has followed.
  void order_flight();
  /// A flight is under way that this bridge did not start, since it was restarted: it arms only when ordered.
  void flight_is_under_way();
  /// Lands the vehicle if the bridge flies it. @param why  for the log and VEHICLE_STATUS
  void land(const std::string& why);
  void step(UTime now);
  /// The process ends: parameters that were set are restored as soon as the vehicle is disarmed.
  void end_parameters() {
    ends_ = true;
    ordered_ = ordered_by_goal_ = false;
  }
  /// Whether the autopilot still has parameters that this bridge has set.
  [[nodiscard]] bool has_set_parameters() const { return parameters_.has_written(); }

  /// Returns the frames to send, in order, since the last call.
  std::vector<Frame> take_frames() { return out_.take_frames(); }
  /// Returns the frames to send to the companion's estimator since the last call.
  std::vector<Frame> take_companion_frames() { return companion_out_.take_frames(); }
  /// The estimated state in W, or nullopt before the first one. @pre the caller publishes each `at` once
  [[nodiscard]] std::optional<UavState> state() const;
  /// The newest estimate with its covariances, with `odometry`. @pre as state()
  [[nodiscard]] const std::optional<tern::Odometry>& estimate() const { return report_.newest(); }
  /// The true state in W (TruthAnchor), where the autopilot reports it (simulation); nullopt before the first estimate.
  [[nodiscard]] std::optional<UavState> truth() const { return in_world(truth_.apply(autopilot_.truth())); }
  [[nodiscard]] VehicleStatus status(UTime now) const;
  /// Returns lines for the log since the last call.
  std::vector<std::string> take_log_lines() { return out_.take_log_lines(); }
  [[nodiscard]] Stage stage() const { return at_.stage; }
  /// Drag and lag as this flight shows them. nullopt: not a PX4, or not enough motion.
  [[nodiscard]] std::optional<FlightIdentification::Answer> measured() const { return tracking_.measured(); }
  [[nodiscard]] const Autopilot& autopilot() const { return autopilot_; }
  /// Whether this bridge must land the vehicle before it ends.
  [[nodiscard]] bool flies() const {
    return at_.stage == Stage::Engaging || at_.stage == Stage::Climbing || at_.stage == Stage::Following ||
           at_.stage == Stage::Landing;
  }

 private:
  /// The present stage with all that belongs to it alone. A change of stage begins a new one.
  struct Present {
    Stage stage = Stage::Waiting;
    std::string why;  ///< reason of the stage
    UTime since;
    std::string refusal;               ///< text of the newest refused command
    bool take_off_asked = false;       ///< Engaging
    std::optional<UTime> rests_since;  ///< Climbing: at uav.start
    bool landing_seen = false;         ///< Landing: the autopilot has reported the landing mode
    bool battery_missed = false;       ///< Following: it was logged that no charge is reported
    std::optional<UTime> lost_since;   ///< Following: at rest without an ODOMETRY to fly by
  };

  // Stages (bridge_stages.cpp).
  void enter(Stage stage, const std::string& why = {});
  void step_stage(UTime now);
  void step_waiting(UTime now);
  void step_ready(UTime now);
  void step_engaging(UTime now);
  void engage_next(UTime now);
  void request_take_off(UTime now);
  void step_flying(UTime now);
  void climb(UTime now);
  void follow(UTime now);
  void stay_while_apart(UTime now);
  [[nodiscard]] bool has_lost_odometry(UTime now);
  void step_landing(UTime now);
  void stand_back(const std::string& why);
  void hold_here(UTime now);

  // Faults (bridge_faults.cpp): "" if nothing is wrong.
  [[nodiscard]] std::string not_ready(UTime now) const;
  [[nodiscard]] std::string parameters_fault() const;
  [[nodiscard]] std::string estimate_fault(UTime now) const;
  [[nodiscard]] std::string odometry_fault(UTime now) const;
  [[nodiscard]] std::string why_not_following(UTime now) const;
  [[nodiscard]] bool setpoint_near(UTime now) const;
  [[nodiscard]] std::vector<RequiredParameter> required() const;

  // Messages to the autopilot (bridge_out.cpp).
  void send_heartbeats();
  void request_streams(UTime now);
  void request_parameters(UTime now);
  void send_vision(const UavState& local);
  void stream(UTime now);
  [[nodiscard]] bool is_silent() const;
  [[nodiscard]] bool may_be_in_failsafe(UTime now) const;
  [[nodiscard]] Duration lead() const;
  [[nodiscard]] Vec3 fed_forward(const MotionSample& m, bool following, UTime now) const;
  [[nodiscard]] MotionSample with_feed_forward(const MotionSample& m, bool following, UTime now);
  [[nodiscard]] bool is_ground_station() const;

  // Errors of the estimate (bridge_odometry.cpp).
  void take_estimate();

  void receive_answer(const CommandAck& ack);
  void watch_clock();
  /// Whether the vehicle takes off by NAV_TAKEOFF: a setpoint would end that.
  [[nodiscard]] bool is_taking_off() const {
    return autopilot_.stack().takes_off_by_command() && autopilot_.taking_off();
  }
  /// Whether the vehicle flies in the following mode: it lives on the bridge's setpoints.
  [[nodiscard]] bool is_flown() const { return autopilot_.armed() && autopilot_.follows() && in_air(); }
  [[nodiscard]] bool in_air() const { return autopilot_.landed() == std::optional(false); }
  [[nodiscard]] std::optional<UavState> in_world(std::optional<UavState> local) const;

  BridgeConfig config_;
  UavSpec uav_;
  Vec3 origin_;  ///< origin of the local frame, in W, m
  Autopilot autopilot_;
  CommandedMotion command_;
  bool setpoint_received_ = false;
  Present at_;
  UTime now_;                     ///< of the newest step
  bool has_followed_ = false;     ///< since its start
  bool ordered_;                  ///< to fly: by `start: arm` or by a GOAL
  bool ordered_by_goal_ = false;  ///< such an order also takes over a vehicle that is armed already
  bool ends_ = false;
  Outbox out_;
  ModeArbiter modes_;
  ParameterExchange parameters_;
  Timer next_heartbeat_, next_timesync_, next_target_, next_streams_;
  std::optional<UTime> streaming_since_, arm_asked_;
  VisionCheck vision_;
  UTime sent_vision_;  ///< time of the newest state sent as ODOMETRY
  OdometryReport report_;
  FlownFrame frame_;
  ClockFit companion_clock_;
  Outbox companion_out_;
  TruthAnchor truth_;
  TiltRamp tilt_ramp_;
  TrackingReport tracking_;
  FedOffset offset_;  ///< of the setpoints to an ArduPilot
  UTime offset_at_;   ///< its time
  FollowRecord follow_record_;
  bool lag_was_logged_ = false;
  bool clock_is_off_ = false;    ///< logged for this flight
  bool followed_ = false;        ///< when the last setpoint was sent
  UavState last_sent_;           ///< newest command sent while following
  std::optional<UavState> own_;  ///< command while not following: at rest here, or climbing; none in stage Waiting
};

}  // namespace tern::mavlink
