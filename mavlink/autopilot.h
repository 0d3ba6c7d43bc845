// What is known of an autopilot from its messages: mode, position, health, clock, parameters.
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
#include "mavlink/messages.h"

namespace tern::mavlink {

/// An older estimate says nothing of where the vehicle is.
inline constexpr Duration kStateAge{500'000};

enum class Firmware : std::uint8_t { Px4, ArduPilot, Other };

/// MAV_CMD.
inline constexpr std::uint16_t kNavLand = 21, kNavTakeoff = 22, kDoSetMode = 176, kArmDisarm = 400,
                               kSetMessageInterval = 511, kRequestMessage = 512;
/// MAV_RESULT.
inline constexpr std::uint8_t kAccepted = 0, kInProgress = 5;
inline constexpr std::uint8_t kArmedBit = 128;
/// Silent for longer, and the link counts as lost: its states come at 30 to 100 Hz.
inline constexpr Duration kLinkSilence{300'000};

/// "temporarily rejected", "denied" …
std::string result_text(std::uint8_t mav_result);

/// Pure: hears frames, answers questions. The first HEARTBEAT of an autopilot (component 1) decides who it is; frames
/// of any other system or component change nothing and are counted.
class Autopilot {
 public:
  /// @param system  only this system id; 0: the first that is heard
  explicit Autopilot(std::uint8_t system = 0) : wanted_(system) {}

  /// @return whether the frame is the autopilot's
  bool receive(const Frame& frame, UTime received);

  [[nodiscard]] const std::optional<Address>& address() const { return address_; }
  [[nodiscard]] Firmware firmware() const;
  /// It is heard, and its mode too since the last silence: HEARTBEAT comes at 1 Hz only.
  [[nodiscard]] bool linked(UTime now) const {
    return address_ && !mode_is_old_ && now - last_received_ <= kLinkSilence;
  }
  [[nodiscard]] UTime last_received() const { return last_received_; }
  /// Whether frames come again after a silence, but no HEARTBEAT yet.
  [[nodiscard]] bool mode_is_old() const { return mode_is_old_; }
  /// The longest silence since the newest HEARTBEAT, the one that lasts included: so long nobody knows its mode.
  [[nodiscard]] Duration silence(UTime now) const { return std::max(longest_gap_, now - last_received_); }
  [[nodiscard]] bool armed() const { return (heartbeat_.base_mode & kArmedBit) != 0; }
  /// Its own word: "OFFBOARD", "GUIDED", "AUTO.LAND".
  [[nodiscard]] std::string mode() const;
  /// When HEARTBEAT told it last.
  [[nodiscard]] UTime mode_received() const { return mode_received_; }
  /// DO_SET_MODE's parameters for the mode that it is in.
  [[nodiscard]] std::array<float, 7> mode_command() const;
  /// The mode that follows setpoints: OFFBOARD of PX4, GUIDED of ArduPilot; and the one that lands.
  [[nodiscard]] const char* following_mode() const;
  [[nodiscard]] const char* landing_mode() const;
  [[nodiscard]] bool follows() const { return mode() == following_mode(); }
  [[nodiscard]] bool landing() const { return mode() == landing_mode(); }
  /// It does not what it was told, but what its failsafe is set to (PX4: HEARTBEAT's system_status is critical).
  [[nodiscard]] bool in_failsafe() const;
  [[nodiscard]] std::optional<bool> landed() const { return landed_; }
  /// A take-off of its own is under way, as EXTENDED_SYS_STATE says.
  [[nodiscard]] bool taking_off() const { return taking_off_; }
  [[nodiscard]] std::optional<double> battery() const { return battery_; }  ///< [0, 1]
  /// Lost: it has had no position or velocity for kFaultPasses, or never yet. A fault of its inputs takes that from a
  /// PX4's flags for a moment, while the position is good.
  [[nodiscard]] EstimatorHealth estimator() const;
  [[nodiscard]] Vec3 sigma() const;  ///< the estimator's own accuracy per axis, m; 0: not said
  [[nodiscard]] const ClockFit& clock() const { return clock_; }
  [[nodiscard]] int resets() const { return resets_; }
  /// The newest state in its local frame, as ENU; `at` is ours. a and j are zero: it does not say them.
  [[nodiscard]] const std::optional<UavState>& state() const { return state_; }
  /// When it was first heard to be armed, or disarmed, as it is now.
  [[nodiscard]] UTime arming_changed() const { return arming_changed_; }
  /// Home's height in the local frame, m, as GLOBAL_POSITION_INT had it since then: arming may move home. nullopt: not
  /// said.
  [[nodiscard]] std::optional<double> home_height() const { return home_height_; }
  /// The newest true state by HIL_STATE_QUATERNION, as ENU from GPS_GLOBAL_ORIGIN, or from where the first one was
  /// (take_own_origin); nothing before an origin is known. Only simulators say it. One that states no time, as PX4's
  /// does, counts for when it was received.
  [[nodiscard]] const std::optional<UavState>& truth() const { return truth_; }
  /// An estimator without GPS says no origin: external vision gives it one. A vehicle that stands disarmed when its
  /// truth is first heard is at the origin. Of one that is armed the truth is shifted so that it agrees with the
  /// estimate; there is none before it has one.
  void take_own_origin() { own_origin_ = true; }
  [[nodiscard]] const std::map<std::string, double>& parameters() const { return parameters_; }
  /// The newest STATUSTEXT, warning or worse. To "Arming denied …" the newest "Preflight Fail …" is added, which says
  /// why.
  [[nodiscard]] std::string last_warning() const;
  /// Acknowledgements and texts since the last call.
  std::deque<CommandAck> take_acks() { return std::exchange(acks_, {}); }
  std::deque<std::string> take_texts() { return std::exchange(texts_, {}); }
  [[nodiscard]] std::int64_t strangers() const { return strangers_; }  ///< frames of others

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
  std::optional<UTime> placed_;  ///< when the estimator last said that it has a position and velocity
  UTime health_received_;
  ClockFit clock_;
  std::optional<std::uint8_t> reset_counter_;
  int resets_ = 0;
  std::optional<UavState> state_, truth_;
  std::optional<UTime> last_odometry_;
  std::optional<HilStateQuaternion> last_truth_;
  std::optional<double> home_height_;
  double yaw_ = 0.0;
  std::optional<GpsGlobalOrigin> origin_;
  bool own_origin_ = false;
  Vec3 own_shift_ = Vec3::Zero();  ///< of an origin of its own, ENU
  std::map<std::string, double> parameters_;
  std::string warning_, failed_check_;
  std::deque<CommandAck> acks_;
  std::deque<std::string> texts_;
  std::string text_;  ///< what has come of a text in several chunks
  std::uint16_t text_id_ = 0;
  std::int64_t strangers_ = 0;
};

}  // namespace tern::mavlink
