// The state of an autopilot as its messages report it: mode, position, health, clock, parameters.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"
#include "mavlink/clock_fit.h"
#include "mavlink/flight_stack.h"
#include "mavlink/messages.h"

namespace tern::mavlink {

/// An older estimate does not count as the vehicle's position.
inline constexpr Duration kStateAge{500'000};

/// MAV_CMD.
inline constexpr std::uint16_t kNavLand = 21, kNavTakeoff = 22, kDoSetMode = 176, kArmDisarm = 400,
                               kSetMessageInterval = 511, kRequestMessage = 512;
/// MAV_RESULT.
inline constexpr std::uint8_t kAccepted = 0, kInProgress = 5;
inline constexpr std::uint8_t kArmedBit = 128;
/// After this long without a frame the link counts as lost. States come at 30 to 100 Hz.
inline constexpr Duration kLinkSilence{300'000};

/// Returns the text of a MAV_RESULT: "temporarily rejected", "denied" …
std::string result_text(std::uint8_t mav_result);

/// Collects what an autopilot reports. Pure: frames and receive times in.
///
/// The sender of the first HEARTBEAT of an autopilot (component 1) is the autopilot. Frames of any other system or
/// component are counted and ignored.
class Autopilot {
 public:
  /// @param system  the system id to accept; 0: that of the first HEARTBEAT
  explicit Autopilot(std::uint8_t system = 0) : wanted_(system) {}

  /// Takes a frame. @return whether it is the autopilot's
  bool receive(const Frame& frame, UTime received);

  [[nodiscard]] const std::optional<Address>& address() const { return address_; }
  [[nodiscard]] Firmware firmware() const;
  [[nodiscard]] const FlightStack& stack() const { return flight_stack(firmware()); }
  /// Whether frames arrive, and HEARTBEAT has reported the mode since the last silence. HEARTBEAT has only 1 Hz.
  [[nodiscard]] bool linked(UTime now) const {
    return address_ && !mode_is_old_ && now - last_received_ <= kLinkSilence;
  }
  [[nodiscard]] UTime last_received() const { return last_received_; }
  /// Whether frames arrive again after a silence, without a HEARTBEAT yet.
  [[nodiscard]] bool mode_is_old() const { return mode_is_old_; }
  /// The longest silence since the newest HEARTBEAT, including the present one. During it the mode may have changed.
  [[nodiscard]] Duration silence(UTime now) const { return std::max(longest_gap_, now - last_received_); }
  [[nodiscard]] bool armed() const { return (heartbeat_.base_mode & kArmedBit) != 0; }
  /// The name of the mode: "OFFBOARD", "GUIDED", "AUTO.LAND"; "" before the first HEARTBEAT.
  [[nodiscard]] std::string mode() const;
  /// Receive time of the newest HEARTBEAT.
  [[nodiscard]] UTime mode_received() const { return mode_received_; }
  /// The parameters of DO_SET_MODE for the present mode.
  [[nodiscard]] CommandParams mode_command() const { return stack().mode_command(heartbeat_.custom_mode); }
  [[nodiscard]] bool follows() const { return mode() == stack().following_mode(); }
  [[nodiscard]] bool landing() const { return mode() == stack().landing_mode(); }
  /// Whether it is in a failsafe: armed, and HEARTBEAT's system_status is critical or emergency.
  [[nodiscard]] bool in_failsafe() const;
  /// Whether the mode lands or returns, which a failsafe chooses.
  [[nodiscard]] bool comes_down() const;
  [[nodiscard]] std::optional<bool> landed() const { return landed_; }
  /// Whether EXTENDED_SYS_STATE reports a take-off.
  [[nodiscard]] bool taking_off() const { return taking_off_; }
  [[nodiscard]] std::optional<double> battery() const { return battery_; }  ///< [0, 1]
  /// Lost: position or velocity has been missing for kFaultPasses, or from the start. A shorter gap counts as Degraded:
  /// an input fault clears a PX4's flags for a moment while the position is good.
  [[nodiscard]] EstimatorHealth estimator() const;
  [[nodiscard]] Vec3 sigma() const;  ///< the estimator's accuracy per axis, m; 0: not reported
  [[nodiscard]] const ClockFit& clock() const { return clock_; }
  /// Number of resets of the estimate: changes of ODOMETRY's counter. LOCAL_POSITION_NED has none, so there it is the
  /// number of jumps (estimate_jumps).
  [[nodiscard]] int resets() const { return resets_; }
  /// The newest state in its local frame, as ENU, with `at` in our clock. a and j are zero: they are not reported.
  [[nodiscard]] const std::optional<UavState>& state() const { return state_; }
  /// The newest ODOMETRY with its time in our clock, once. nullopt time: its clock is unknown, or it is over 1 s old.
  std::optional<std::pair<Odometry, std::optional<UTime>>> take_odometry() { return std::exchange(odometry_, {}); }
  /// Receive time of the first HEARTBEAT with the present arming.
  [[nodiscard]] UTime arming_changed() const { return arming_changed_; }
  /// Height of home in the local frame, m, from GLOBAL_POSITION_INT since the arming last changed, since arming may
  /// move home. nullopt: not reported.
  [[nodiscard]] std::optional<double> home_height() const { return home_height_; }
  /// The newest true state from HIL_STATE_QUATERNION, which only simulators send. It is ENU relative to
  /// GPS_GLOBAL_ORIGIN, or to an own origin (take_own_origin); nullopt before an origin is known. A message without a
  /// time, as of a PX4, gets its receive time.
  [[nodiscard]] const std::optional<UavState>& truth() const { return truth_; }
  /// Uses an own origin for the truth: an estimator without GPS, as with external vision, reports none. If the vehicle
  /// is disarmed when the first truth arrives, it is at the origin. If it is armed, the truth is shifted to agree with
  /// the estimate, and there is none before an estimate.
  void take_own_origin() { own_origin_ = true; }
  [[nodiscard]] const ParameterValues& parameters() const { return parameters_; }
  /// The newest STATUSTEXT of severity warning or worse. "Arming denied …" is followed by the newest "Preflight Fail
  /// …", which contains the reason.
  [[nodiscard]] std::string last_warning() const;
  /// Return acknowledgements and texts since the last call.
  std::deque<CommandAck> take_acks() { return std::exchange(acks_, {}); }
  std::deque<std::string> take_texts() { return std::exchange(texts_, {}); }
  [[nodiscard]] std::int64_t strangers() const { return strangers_; }  ///< number of frames from other senders

 private:
  void receive_health(const EstimatorStatus& status, UTime received);
  void receive_position(const Frame& frame, UTime received);
  void receive_truth(const HilStateQuaternion& hil, UTime received);
  void receive_parameter(const ParamValue& value);
  void receive_text(const StatusText& chunk);
  [[nodiscard]] std::optional<UTime> ours(std::uint64_t theirs_us, UTime received) const;

  std::uint8_t wanted_;
  std::optional<Address> address_;
  Heartbeat heartbeat_;
  UTime last_received_, mode_received_, arming_changed_;
  bool mode_is_old_ = false;
  Duration longest_gap_;
  std::optional<bool> landed_;
  bool taking_off_ = false;
  std::optional<double> battery_;
  std::optional<EstimatorStatus> health_;
  std::optional<UTime> placed_;  ///< when the estimator last reported position and velocity
  UTime health_received_;
  ClockFit clock_;
  std::optional<std::uint8_t> reset_counter_;
  int resets_ = 0;
  std::optional<UavState> state_, truth_;
  std::optional<UTime> last_odometry_;
  std::optional<std::pair<Odometry, std::optional<UTime>>> odometry_;
  std::optional<HilStateQuaternion> last_truth_;
  std::optional<double> home_height_;
  double yaw_ = 0.0;
  std::optional<GpsGlobalOrigin> origin_;
  bool own_origin_ = false;
  Vec3 own_shift_ = Vec3::Zero();  ///< of the truth from the own origin, ENU, m
  ParameterValues parameters_;
  std::string warning_, failed_check_;
  std::deque<CommandAck> acks_;
  std::deque<std::string> texts_;
  std::string text_;  ///< the chunks of a text so far
  std::uint16_t text_id_ = 0;
  std::int64_t strangers_ = 0;
};

}  // namespace tern::mavlink
