// Between SETPOINT and an autopilot: take-off, following, standing back, landing.
#pragma once

#include <string>
#include <vector>

#include "core/world/scenario.h"
#include "executor/commanded_motion.h"
#include "mavlink/autopilot.h"
#include "mavlink/bridge_config.h"
#include "mavlink/required_parameters.h"
#include "mavlink/tracking_lag.h"

namespace tern::mavlink {

/// MAV_COMP_ID_ONBOARD_COMPUTER.
inline constexpr std::uint8_t kOwnComponent = 191;
/// Rounds of requests after which a parameter that has not come is not there: of 20 % lost packets one in 10^5 each
/// way.
inline constexpr int kAskedOften = 6;

/// Where a flight is.
enum class Stage : std::uint8_t {
  Waiting,    ///< for a link, an estimate, a clock, parameters
  Ready,      ///< to be told to fly, or for the pilot
  Engaging,   ///< asks for OFFBOARD, then to be armed
  Climbing,   ///< from the ground to uav.start
  Following,  ///< flies SETPOINT
  StoodBack,  ///< somebody else flies; until told again
  Landing,
  Landed
};
const char* to_string(Stage stage);

/// Pure: frames and times in, frames out. The caller sends what take_frames() gives and calls step() at rate_hz or
/// more.
///
/// W is the autopilot's local frame, shifted: the local origin lies at (uav.start.x, uav.start.y, 0). So a vehicle that
/// has started its estimator where it stands climbs straight up to uav.start. What is said to the autopilot: HEARTBEAT
/// 2 Hz, TIMESYNC 10 Hz, in flight five times a second the question for its HEARTBEAT. From the moment that its
/// position is known SET_POSITION_TARGET_LOCAL_NED goes out at rate_hz: the stream runs before OFFBOARD is asked for.
/// It carries
///   p, v of the command half a period later, acceleration_gain·a(now + lead_s) + drag_per_s·v, and the heading.
/// An autopilot holds it for a period, and would else be half a period late. An ArduPilot carries it on: p, v of now.
/// The gain is for level axes: the D term of an autopilot's vertical loop is 0. While the vehicle is not following, the
/// command is to stay where it is.
///
/// While the estimate is dead the vehicle is not following: it is told to come to rest where it was commanded to be.
///
/// An ArduPilot is asked to take off (NAV_TAKEOFF), to uav.start's height above its home. Setpoints would end that:
/// they begin when it is up, and none are sent before it follows. A take-off that is found under way is waited for,
/// too.
///
/// Following begins when OFFBOARD and armed are confirmed by HEARTBEAT, in the air. It ends when the autopilot leaves
/// OFFBOARD or disarms, by a pilot, a failsafe or a bridge of another. The bridge then stands back and stops its
/// stream. With start pilot the stream goes on and says the vehicle's own place. The bridge flies again only when told:
/// by a new GOAL, or with start pilot by the switch. A vehicle that it finds armed, but not in OFFBOARD, is somebody
/// else's, too. So is one that is armed in another mode while the bridge engages or lands it. A bridge that was started
/// anew and finds the vehicle armed and in OFFBOARD in the air goes on following.
///
/// A pilot may switch while a mode that the bridge has commanded is on its way, or just before. So a mode is commanded
/// right after HEARTBEAT has told the one before, with a question for HEARTBEAT in front. A mode that is neither the
/// one before nor the one commanded is a pilot's. The bridge stands back, and if its own command comes into effect
/// after all, it commands the pilot's mode.
///
/// It has landed when the autopilot is disarmed and 1.5 s have passed since the bridge last asked for arming.
///
/// PX4 takes OFFBOARD up again by itself as soon as setpoints come again, whatever its failsafe was doing. So none is
/// sent while the vehicle may be in one. After a silence of COM_OF_LOSS_T, HEARTBEAT has to tell the mode first. While
/// it tells of a failsafe there are none, unless somebody told the bridge to fly.
class Bridge {
 public:
  Bridge(const BridgeConfig& config, const UavSpec& uav, UTime now);

  void receive(const Frame& frame, UTime received);
  void receive(const UavState& setpoint);
  void receive(const TimedSpline& committed) { command_.receive(committed); }
  void receive(const Plan& plan) { command_.receive(plan); }
  /// Where a motion-capture system sees the vehicle, W. Nothing comes of it unless external_vision is on.
  void receive_vision(const UavState& seen);
  /// Somebody wants it to fly: a new GOAL of mode Go.
  void order_flight();
  /// A flight has begun that this bridge knows nothing of (it was started anew): it does not arm unless told.
  void flight_is_under_way();
  void land(const std::string& why);
  void step(UTime now);

  /// What is to be sent, in order.
  std::vector<Frame> take_frames() { return std::exchange(out_, {}); }
  /// In W; nullopt while nothing is known. @pre the caller publishes each `at` once
  [[nodiscard]] std::optional<UavState> state() const { return in_world(autopilot_.state()); }
  /// W is the estimator's frame as it was before take-off: there the truth agrees with the estimate, and what is
  /// between them later has come since. Of a vehicle that is first seen armed, as by a bridge that was started anew,
  /// the truth agrees with the estimate of then. nullopt before there was an estimate.
  [[nodiscard]] std::optional<UavState> truth() const;
  [[nodiscard]] VehicleStatus status(UTime now) const;
  /// Sentences for the log since the last call.
  std::vector<std::string> take_log_lines() { return std::exchange(log_lines_, {}); }
  [[nodiscard]] Stage stage() const { return stage_; }
  [[nodiscard]] const Autopilot& autopilot() const { return autopilot_; }
  /// Whether this bridge has to see to the vehicle's landing when it is asked to end.
  [[nodiscard]] bool flies() const {
    return stage_ == Stage::Engaging || stage_ == Stage::Climbing || stage_ == Stage::Following ||
           stage_ == Stage::Landing;
  }

 private:
  /// The system is the autopilot's when that is known.
  static constexpr Address kSelf{1, kOwnComponent};
  /// A command that was sent this long ago has come to nothing, or HEARTBEAT tells of it.
  static constexpr Duration kCommandFlight{1'500'000};
  void enter(Stage stage, const std::string& why = {});
  void step_stage(UTime now);
  void step_waiting(UTime now);
  void step_ready(UTime now);
  void step_engaging(UTime now);
  void step_flying(UTime now);
  void step_landing(UTime now);
  void climb(UTime now);
  void stand_back(const std::string& why);
  [[nodiscard]] bool is_taken_over();
  [[nodiscard]] std::string other_pilot_reason() const;
  void request_disarm(UTime now);
  void engage_next(UTime now);
  void request_parameters(UTime now);
  void request_streams(UTime now);
  void request_mode(UTime now);
  /// COMMAND_LONG that makes it enter `wanted`, unless HEARTBEAT has not told the mode just now.
  void command_mode(UTime now, const std::string& wanted, std::uint16_t number, const std::array<float, 7>& param);
  /// Of a HEARTBEAT: what it tells of a mode that was commanded.
  void watch_mode(UTime now);
  void forget_commanded_mode();
  void stream(UTime now);
  [[nodiscard]] bool is_silent() const;
  void request_take_off(UTime now);
  /// ArduPilot: setpoints do not lift it off the ground.
  [[nodiscard]] bool takes_off_by_command() const { return autopilot_.firmware() == Firmware::ArduPilot; }
  /// An ArduPilot that a bridge before this one, or somebody, has told to take off: a setpoint would end that.
  [[nodiscard]] bool is_taking_off() const { return takes_off_by_command() && autopilot_.taking_off(); }
  void hold_here(UTime now);
  void anchor_truth();
  void anchor_truth_at_first_sight();
  void watch_clock();
  void watch_lag();
  void send_vision(const UavState& local);
  void command(UTime now, std::uint16_t number, std::array<float, 7> param);
  void request(std::uint16_t number, std::uint32_t message, float interval_us = 0.0F);
  [[nodiscard]] std::vector<RequiredParameter> required() const;
  [[nodiscard]] std::string not_ready(UTime now) const;
  [[nodiscard]] std::string estimate_fault(UTime now) const;
  [[nodiscard]] std::string ground_fault() const;
  [[nodiscard]] std::string why_not_following(UTime now) const;
  [[nodiscard]] bool setpoint_near(UTime now) const;
  [[nodiscard]] std::string clock_fault() const;
  [[nodiscard]] bool may_be_in_failsafe(UTime now) const;
  [[nodiscard]] bool in_air() const { return autopilot_.landed() == std::optional(false); }
  [[nodiscard]] std::optional<UavState> in_world(std::optional<UavState> local) const;
  template <class M>
  void send(const M& message) {
    const std::uint8_t system = autopilot_.address() ? autopilot_.address()->system : kSelf.system;
    out_.push_back(to_frame(message, {system, kSelf.component}, sequence_++));
  }

  BridgeConfig config_;
  UavSpec uav_;
  Vec3 origin_;                       ///< of the local frame, in W
  UTime sent_vision_;                 ///< the time of the newest state that was told
  std::optional<Vec3> truth_anchor_;  ///< added to the truth
  Autopilot autopilot_;
  CommandedMotion command_;
  bool setpoint_received_ = false;
  Stage stage_ = Stage::Waiting;
  std::string why_;               ///< of the newest stage
  bool ordered_;                  ///< to fly
  bool ordered_by_goal_ = false;  ///< by somebody, not by the configuration: also a vehicle that is in somebody's hands
  UTime stage_since_, now_;
  int parameters_asked_ = 0;  ///< rounds
  UTime next_heartbeat_, next_timesync_, next_target_, next_command_, next_parameters_, next_streams_, next_mode_;
  std::optional<UTime> streaming_since_;
  /// How the vehicle was found when the bridge was told to fly it, or began to; until it is in OFFBOARD.
  struct Found {
    std::string mode;
    bool armed = false;
  };
  std::optional<Found> found_;
  struct CommandedMode {
    UTime at;
    std::string before, wanted;
  };
  std::optional<CommandedMode> commanded_mode_;  ///< until HEARTBEAT tells of it
  struct PilotsMode {
    std::string mode;
    std::array<float, 7> command;  ///< of DO_SET_MODE
  };
  std::optional<PilotsMode> pilots_mode_;  ///< chosen while a mode that was commanded was on its way
  bool take_off_asked_ = false;            ///< since it began to engage
  bool landing_seen_ = false;              ///< the autopilot has confirmed that it lands
  std::optional<UTime> arm_asked_;
  bool followed_ = false;  ///< at the last setpoint that was sent
  TrackingLag lag_;
  UTime lag_at_;
  bool lag_was_logged_ = false;
  bool clock_is_off_ = false;  ///< was said of the vehicle in flight
  UavState last_sent_;         ///< of what it followed
  UavState own_;               ///< the command while it does not follow: at rest here, or on its way up
  std::string refusal_;        ///< the newest answer to a command that was not taken, in words
  std::uint8_t sequence_ = 0;
  std::vector<Frame> out_;
  std::vector<std::string> log_lines_;
};

}  // namespace tern::mavlink
