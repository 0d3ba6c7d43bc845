// Commanded modes of an autopilot. A pilot's switch has priority over a command of the bridge.
#pragma once

#include <optional>
#include <string>

#include "mavlink/autopilot.h"
#include "mavlink/outbox.h"

namespace tern::mavlink {

/// A command has taken effect, or is lost, within this time.
inline constexpr Duration kCommandFlight{1'500'000};

/// Commands modes so that a pilot's choice is never undone.
///
/// 1. A mode is commanded only within 50 ms after HEARTBEAT has reported the current one. Right before the command a
///    HEARTBEAT is requested: it reports the mode that the command replaces.
/// 2. A mode that is neither the one before nor the commanded one is a pilot's choice.
/// 3. If the command takes effect after that, the pilot's mode is commanded.
///
/// | mode of a new HEARTBEAT, after a command            | effect                                           |
/// |-----------------------------------------------------|--------------------------------------------------|
/// | that before the command, within kCommandFlight      | waits                                            |
/// | that before the command, later                      | the command counts as lost                       |
/// | the commanded one, no pilot has chosen              | the command is done                              |
/// | another one                                         | a pilot has chosen it                            |
/// | the commanded one, after a pilot's choice           | commands the pilot's mode                        |
class ModeArbiter {
 public:
  explicit ModeArbiter(UTime now) : next_request_(now) {}

  /// Requests HEARTBEAT where the mode must be known early. @param flies  the bridge flies the vehicle
  void request_heartbeat(const Autopilot& autopilot, bool flies, UTime now, Outbox& out);
  /// Commands the mode `wanted`, if HEARTBEAT has just reported the current one and a command may be sent.
  void command(const Autopilot& autopilot, UTime now, const std::string& wanted, std::uint16_t number,
               const CommandParams& param, Outbox& out);
  /// Compares the mode of a new HEARTBEAT with the commanded one, by the table.
  /// @return true if a pilot has chosen this mode
  bool watch(const Autopilot& autopilot, UTime now, Outbox& out);
  /// Drops command and pilot's choice.
  void forget();
  [[nodiscard]] bool has_pilots_choice() const { return pilots_.has_value(); }

  /// Keeps mode and arming as found when the bridge was ordered to fly, or began to engage.
  void keep_found(const Autopilot& autopilot) { found_ = Found{autopilot.mode(), autopilot.armed()}; }
  void keep_found_once(const Autopilot& autopilot) {
    if (!found_) keep_found(autopilot);
  }
  void forget_found() { found_.reset(); }
  [[nodiscard]] bool has_found() const { return found_.has_value(); }
  /// Whether another sender has changed mode or arming since then. HEARTBEAT reports both together, and the bridge arms
  /// in the following mode only. So any other mode, or arming in another mode, is someone else's. Reaching the
  /// following mode ends the comparison.
  bool is_taken_over(const Autopilot& autopilot);

 private:
  struct Commanded {
    UTime at;
    std::string before, wanted;
  };
  struct Chosen {
    std::string mode;
    CommandParams command;  ///< parameters of DO_SET_MODE
  };
  struct Found {
    std::string mode;
    bool armed = false;
  };
  std::optional<Commanded> commanded_;  ///< until HEARTBEAT reports it
  std::optional<Chosen> pilots_;        ///< chosen by a pilot while a commanded mode was on its way
  std::optional<Found> found_;
  Timer next_request_;
};

}  // namespace tern::mavlink
