// The bridge between SETPOINT and an autopilot: take-off, following, standing back, landing.
#pragma once

#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "executor/commanded_motion.h"
#include "mavlink/autopilot.h"
#include "mavlink/bridge_config.h"
#include "mavlink/flight_identification.h"
#include "mavlink/required_parameters.h"
#include "mavlink/tilt_ramp.h"
#include "mavlink/tracking_lag.h"
#include "mavlink/vision_check.h"

namespace tern::mavlink {

/// MAV_COMP_ID_ONBOARD_COMPUTER, and MAV_COMP_ID_MISSIONPLANNER of the HEARTBEAT as a ground station.
inline constexpr std::uint8_t kOwnComponent = 191, kGroundStationComponent = 190;
/// After this many requests, a parameter without an answer counts as absent. If 20 % of the packets are lost in one
/// direction, all six are lost with probability 0.2⁶ = 6·10⁻⁵.
inline constexpr int kMaxParameterRounds = 6;

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
/// | order_flight(): a new GOAL                                  | StoodBack, Landed   | Waiting                   |
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
/// p and v are those of half a period later. An ArduPilot extrapolates, so p and v are those of now. The bridge also
/// sends HEARTBEAT at 2 Hz, TIMESYNC at 10 Hz, and in flight a request for the autopilot's HEARTBEAT at 5 Hz.
///
/// When a flight with a PX4 ends, the log has drag and lag as measured, and the settings that they ask for. The lines
/// are missing if FlightIdentification has no answer.
///
/// **Parameters.** With set_parameters, those that decide what happens after a loss, and those of the estimator, are
/// written in stage Waiting. Bounds of the vehicle (speed, tilt, rates) are written only with raise_bounds: otherwise
/// the scenario must fit them. All are set back in stage Landed, and when the process ends, if the vehicle is disarmed.
///
/// **HEARTBEAT as a ground station.** A PX4 sends STATUSTEXT, which says why arming is denied, only to a link with a
/// ground station. So the bridge sends a second HEARTBEAT of that type. It must never stand for an operator's ground
/// station, or its end be taken for the loss of one. So it is sent only if NAV_DLL_ACT was read as 0: the autopilot
/// then acts on no such loss. An ArduPilot sends STATUSTEXT to every link.
///
/// **A pilot's switch has priority.**
/// 1. A mode is commanded only within 50 ms after HEARTBEAT has reported the current one. A request for HEARTBEAT
///    precedes the command, to learn the mode that the command ends.
/// 2. A mode that is neither the one before nor the commanded one is a pilot's choice: the bridge stands back.
/// 3. If the bridge's command takes effect after that, the bridge commands the pilot's mode.
///
/// **Failsafe of a PX4.** PX4 returns to OFFBOARD as soon as it receives setpoints, in any failsafe. So no setpoint is
/// sent while the vehicle may be in a failsafe: after a silence of COM_OF_LOSS_T, HEARTBEAT must report the mode first.
/// During a reported failsafe, setpoints are sent only after order_flight().
///
/// **Take-off of an ArduPilot.** The bridge sends NAV_TAKEOFF, to uav.start's height above the vehicle's home. A
/// setpoint would end that take-off, so setpoints start when the vehicle is up. If a take-off is already under way, the
/// bridge waits for its end.
class Bridge {
 public:
  /// The last bound is the flight box (of the vehicle's centre), wider by this, m. tern-executor rejoins a vehicle up
  /// to RejoinGuard::kMaxExcursion (2 m) outside, and needs as much to brake.
  static constexpr double kLastBound = 4.0;

  Bridge(const BridgeConfig& config, const UavSpec& uav, UTime now);

  void receive(const Frame& frame, UTime received);
  void receive(const UavState& setpoint);
  void receive(const TimedSpline& committed) { command_.receive(committed); }
  void receive(const Plan& plan) { command_.receive(plan); }
  /// Takes the vehicle's state (W) from a motion-capture system. Used only with external_vision.
  void receive_vision(const UavState& seen);
  /// A new GOAL of mode Go orders the vehicle to fly.
  void order_flight();
  /// A flight is under way that this bridge did not start, since it was restarted: it arms only when ordered.
  void flight_is_under_way();
  /// Lands the vehicle if the bridge flies it. @param why  for the log and VEHICLE_STATUS
  void land(const std::string& why);
  void step(UTime now);
  /// The process ends: parameters that were set are set back as soon as the vehicle is disarmed.
  void end_parameters() {
    ends_ = true;
    ordered_ = ordered_by_goal_ = false;
  }
  /// Whether the autopilot still has parameters that this bridge has set.
  [[nodiscard]] bool has_set_parameters() const { return !originals_.empty(); }

  /// Returns the frames to send, in order, since the last call.
  std::vector<Frame> take_frames() { return std::exchange(out_, {}); }
  /// The estimated state in W, or nullopt before the first one. @pre the caller publishes each `at` once
  [[nodiscard]] std::optional<UavState> state() const { return in_world(autopilot_.state()); }
  /// The true state in W, where the autopilot reports it (simulation); nullopt before the first estimate.
  ///
  /// W is the estimator's frame before take-off: there the truth equals the estimate, and a later difference is drift.
  /// If the vehicle is armed when first seen, as by a restarted bridge, the truth equals the estimate of that time.
  [[nodiscard]] std::optional<UavState> truth() const;
  [[nodiscard]] VehicleStatus status(UTime now) const;
  /// Returns lines for the log since the last call.
  std::vector<std::string> take_log_lines() { return std::exchange(log_lines_, {}); }
  [[nodiscard]] Stage stage() const { return stage_; }
  /// Drag and lag as this flight shows them. nullopt: not a PX4, or not enough motion.
  [[nodiscard]] std::optional<FlightIdentification::Answer> measured() const { return identification_.answer(); }
  [[nodiscard]] const Autopilot& autopilot() const { return autopilot_; }
  /// Whether this bridge must land the vehicle before it ends.
  [[nodiscard]] bool flies() const {
    return stage_ == Stage::Engaging || stage_ == Stage::Climbing || stage_ == Stage::Following ||
           stage_ == Stage::Landing;
  }

 private:
  /// Sender's address. The system id is replaced by the autopilot's once that is known.
  static constexpr Address kSelf{1, kOwnComponent};
  /// A command has taken effect, or is lost, within this time.
  static constexpr Duration kCommandFlight{1'500'000};
  void enter(Stage stage, const std::string& why = {});
  void step_stage(UTime now);
  void step_waiting(UTime now);
  void step_ready(UTime now);
  void step_engaging(UTime now);
  void step_flying(UTime now);
  void step_landing(UTime now);
  void climb(UTime now);
  void stay_while_apart(UTime now);
  void stand_back(const std::string& why);
  [[nodiscard]] bool is_taken_over();
  [[nodiscard]] std::string other_pilot_reason() const;
  [[nodiscard]] std::string mode_change_reason() const;
  [[nodiscard]] std::string failsafe_reason() const;
  [[nodiscard]] std::string beyond_last_bound(UTime now) const;
  [[nodiscard]] bool is_ground_station() const;
  void watch_following(UTime now);
  void request_disarm(UTime now);
  void engage_next(UTime now);
  void request_parameters(UTime now);
  void write_parameter(const std::string& name, double value, bool integer);
  void set_back_parameters(UTime now);
  void request_streams(UTime now);
  void request_mode(UTime now);
  /// Commands the mode `wanted`, if HEARTBEAT has just reported the current one.
  void command_mode(UTime now, const std::string& wanted, std::uint16_t number, const std::array<float, 7>& param);
  /// Compares the mode of a new HEARTBEAT with the commanded one.
  void watch_mode(UTime now);
  void forget_commanded_mode();
  [[nodiscard]] Vec3 derivative_gain() const;
  [[nodiscard]] Duration lead() const;
  [[nodiscard]] std::optional<LoopGains> level_gains() const;
  void stream(UTime now);
  [[nodiscard]] bool is_silent() const;
  void request_take_off(UTime now);
  /// ArduPilot: setpoints do not lift the vehicle off the ground.
  [[nodiscard]] bool takes_off_by_command() const { return autopilot_.firmware() == Firmware::ArduPilot; }
  /// Whether an ArduPilot takes off by NAV_TAKEOFF: a setpoint would end that.
  [[nodiscard]] bool is_taking_off() const { return takes_off_by_command() && autopilot_.taking_off(); }
  void hold_here(UTime now);
  void anchor_truth();
  void anchor_truth_at_first_sight();
  void watch_clock();
  void watch_lag();
  void report_measured();
  void send_vision(const UavState& local);
  void command(UTime now, std::uint16_t number, std::array<float, 7> param);
  void request(std::uint16_t number, std::uint32_t message, float interval_us = 0.0F);
  [[nodiscard]] std::vector<RequiredParameter> required() const;
  [[nodiscard]] std::vector<RequiredParameter> required_and_read() const;
  [[nodiscard]] std::string not_ready(UTime now) const;
  [[nodiscard]] std::string estimate_fault(UTime now) const;
  [[nodiscard]] bool is_vision_silent(UTime now) const;
  [[nodiscard]] std::string ground_fault() const;
  [[nodiscard]] std::string why_not_following(UTime now) const;
  [[nodiscard]] std::string tilt_fault(UTime now) const;
  [[nodiscard]] std::string parameter_list() const;
  [[nodiscard]] bool setpoint_near(UTime now) const;
  [[nodiscard]] std::string clock_fault() const;
  [[nodiscard]] bool may_be_in_failsafe(UTime now) const;
  /// Whether the vehicle flies in the following mode: it lives on the bridge's setpoints.
  [[nodiscard]] bool is_flown() const { return autopilot_.armed() && autopilot_.follows() && in_air(); }
  [[nodiscard]] bool in_air() const { return autopilot_.landed() == std::optional(false); }
  [[nodiscard]] std::optional<UavState> in_world(std::optional<UavState> local) const;
  template <class M>
  void send(const M& message) {
    const std::uint8_t system = autopilot_.address() ? autopilot_.address()->system : kSelf.system;
    out_.push_back(to_frame(message, {system, kSelf.component}, sequence_++));
  }
  void send_heartbeats();

  BridgeConfig config_;
  UavSpec uav_;
  Vec3 origin_;        ///< origin of the local frame, in W, m
  UTime sent_vision_;  ///< time of the newest state sent as ODOMETRY
  VisionCheck vision_;
  std::optional<Vec3> truth_anchor_;  ///< added to the position of the truth
  Autopilot autopilot_;
  CommandedMotion command_;
  bool setpoint_received_ = false;
  Stage stage_ = Stage::Waiting;
  std::string why_;               ///< reason of the newest stage
  bool ordered_;                  ///< to fly: by `start: arm` or by a GOAL
  bool ordered_by_goal_ = false;  ///< such an order also takes over a vehicle that is armed already
  UTime stage_since_, now_;
  int parameters_asked_ = 0;  ///< rounds of requests
  struct Original {
    double value = 0.0;
    bool integer = false;
    bool asked_back = false;  ///< it was sent back: from then on the autopilot's answer counts
  };
  std::map<std::string, Original> originals_;  ///< of the parameters that were set
  bool ends_ = false;
  UTime next_heartbeat_, next_timesync_, next_target_, next_command_, next_parameters_, next_streams_, next_mode_;
  std::optional<UTime> streaming_since_;
  /// Mode and arming when the bridge was ordered to fly, or began to engage. Kept until the following mode is reached.
  struct Found {
    std::string mode;
    bool armed = false;
  };
  std::optional<Found> found_;
  struct CommandedMode {
    UTime at;
    std::string before, wanted;
  };
  std::optional<CommandedMode> commanded_mode_;  ///< until HEARTBEAT reports it
  struct PilotsMode {
    std::string mode;
    std::array<float, 7> command;  ///< parameters of DO_SET_MODE
  };
  std::optional<PilotsMode> pilots_mode_;  ///< chosen by a pilot while a commanded mode was on its way
  bool take_off_asked_ = false;            ///< since stage Engaging
  bool landing_seen_ = false;              ///< the autopilot has reported the landing mode
  std::optional<UTime> arm_asked_;
  bool followed_ = false;  ///< when the last setpoint was sent
  TiltRamp tilt_ramp_;
  std::optional<UTime> rests_since_;  ///< at uav.start, after the climb
  TrackingLag lag_;
  FlightIdentification identification_;
  UTime lag_at_;
  bool lag_was_logged_ = false;
  bool clock_is_off_ = false;    ///< logged for this flight
  UavState last_sent_;           ///< newest command sent while following
  std::optional<UavState> own_;  ///< command while not following: at rest here, or climbing; none in stage Waiting
  std::string refusal_;          ///< text of the newest refused command
  bool has_followed_ = false;    ///< since the vehicle was armed
  std::optional<UTime> not_following_since_;  ///< if has_followed_
  std::uint8_t sequence_ = 0, ground_station_sequence_ = 0;
  std::vector<Frame> out_;
  std::vector<std::string> log_lines_;
};

}  // namespace tern::mavlink
