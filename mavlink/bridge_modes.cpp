// Commanded modes. A pilot's switch has priority over a command of the bridge.
#include <fmt/format.h>

#include <algorithm>

#include "mavlink/bridge.h"

namespace tern::mavlink {
namespace {

/// Periods of requests for HEARTBEAT, which an autopilot sends once a second by itself.
constexpr Duration kModePeriod{200'000}, kOldModePeriod{50'000};
/// Within this time after a HEARTBEAT its mode is current.
constexpr Duration kJustNow{50'000};

}  // namespace

/// Messages of an autopilot that is not known yet come from one that is there already, as after a restart in flight.
/// Its next HEARTBEAT may be a second away, so one is requested of every system that hears this.
void Bridge::request_mode(UTime now) {
  if (!autopilot_.address() && autopilot_.strangers() > 0 && now >= next_mode_) {
    next_mode_ = now + kOldModePeriod;
    request(kRequestMessage, Heartbeat::kId);
  }
  const bool old = autopilot_.mode_is_old();
  if (old) next_mode_ = std::min(next_mode_, now + kOldModePeriod);
  if (now < next_mode_ || !autopilot_.address() || !(old || flies() || commanded_mode_)) return;
  next_mode_ = now + (old ? kOldModePeriod : kModePeriod);
  request(kRequestMessage, Heartbeat::kId);
}

/// Commands are executed in order: the HEARTBEAT that is requested in front reports the mode that this command ends.
void Bridge::command_mode(UTime now, const std::string& wanted, std::uint16_t number,
                          const std::array<float, 7>& param) {
  if (now < next_command_ || now - autopilot_.mode_received() > kJustNow) return;
  request(kRequestMessage, Heartbeat::kId);
  command(now, number, param);
  commanded_mode_ = {now, autopilot_.mode(), wanted};
  next_mode_ = now + kOldModePeriod;
}

void Bridge::watch_mode(UTime now) {
  if (!commanded_mode_) return;
  const std::string mode = autopilot_.mode();
  const CommandedMode commanded = *commanded_mode_;
  const bool gives_back = pilots_mode_ && pilots_mode_->mode == commanded.wanted;
  if (mode == commanded.before) {
    if (gives_back) return command_mode(now, pilots_mode_->mode, kDoSetMode, pilots_mode_->command);
    if (now - commanded.at > kCommandFlight) forget_commanded_mode();
    return;
  }
  if (mode != commanded.wanted) {
    pilots_mode_ = {mode, autopilot_.mode_command()};
    if (stage_ != Stage::StoodBack) stand_back(mode_change_reason());
    return;
  }
  if (!pilots_mode_ || gives_back) return forget_commanded_mode();
  log_lines_.push_back(
      fmt::format("a pilot chose {} before the bridge commanded {}: commanding it again", pilots_mode_->mode, mode));
  command_mode(now, pilots_mode_->mode, kDoSetMode, pilots_mode_->command);
}

void Bridge::forget_commanded_mode() {
  commanded_mode_.reset();
  pilots_mode_.reset();
}

}  // namespace tern::mavlink
