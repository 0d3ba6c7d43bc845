// The output of a bridge: frames to the autopilot, and lines for the log.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "mavlink/flight_stack.h"
#include "mavlink/messages.h"

namespace tern::mavlink {

/// MAV_COMP_ID_ONBOARD_COMPUTER, and MAV_COMP_ID_MISSIONPLANNER of the HEARTBEAT as a ground station.
inline constexpr std::uint8_t kOwnComponent = 191, kGroundStationComponent = 190;

/// Returns true once per period. The period may differ from time to time.
class Timer {
 public:
  explicit Timer(UTime first) : next_(first) {}
  [[nodiscard]] bool is_due(UTime now) const { return now >= next_; }
  void wait(UTime now, Duration period) { next_ = now + period; }
  /// Becomes due within this time.
  void hurry(UTime now, Duration at_most) { next_ = std::min(next_, now + at_most); }
  /// If it is due, waits for a period. @return whether it was due
  bool take(UTime now, Duration period) {
    if (!is_due(now)) return false;
    wait(now, period);
    return true;
  }

 private:
  UTime next_;
};

/// Frames to an autopilot, numbered, and lines for the log, both in order.
class Outbox {
 public:
  static constexpr Duration kCommandPeriod{1'000'000};

  /// @param wanted_system  the autopilot's system id while its address is unknown; 0: all systems
  Outbox(std::uint8_t wanted_system, UTime now) : to_{wanted_system, 0}, next_command_(now) {}

  /// The autopilot's address is known: this end gets its system id.
  void set_target(const Address& autopilot) {
    to_ = autopilot;
    own_system_ = autopilot.system;
  }
  [[nodiscard]] const Address& target() const { return to_; }

  template <class M>
  void send(const M& message) {
    frames_.push_back(to_frame(message, {own_system_, kOwnComponent}, sequence_++));
  }
  template <class M>
  void send_as_ground_station(const M& message) {
    frames_.push_back(to_frame(message, {own_system_, kGroundStationComponent}, ground_station_sequence_++));
  }
  /// Sends COMMAND_LONG, which changes nothing in the vehicle's flight.
  void request(std::uint16_t number, const CommandParams& param) {
    send(
        CommandLong{.param = param, .command = number, .target_system = to_.system, .target_component = to_.component});
  }
  /// Sends COMMAND_LONG if no command was sent within its period. @return whether it was sent
  bool command(UTime now, std::uint16_t number, const CommandParams& param, Duration period = kCommandPeriod) {
    if (!next_command_.take(now, period)) return false;
    request(number, param);
    return true;
  }
  [[nodiscard]] bool may_command(UTime now) const { return next_command_.is_due(now); }
  /// The next command need not wait.
  void expect_command(UTime now) { next_command_.hurry(now, {}); }
  void log(std::string line) { lines_.push_back(std::move(line)); }

  /// Return frames and lines since the last call.
  std::vector<Frame> take_frames() { return std::exchange(frames_, {}); }
  std::vector<std::string> take_log_lines() { return std::exchange(lines_, {}); }

 private:
  Address to_;
  Timer next_command_;
  std::uint8_t own_system_ = 1;
  std::uint8_t sequence_ = 0, ground_station_sequence_ = 0;
  std::vector<Frame> frames_;
  std::vector<std::string> lines_;
};

}  // namespace tern::mavlink
