#include "mavlink/mode_arbiter.h"

#include <fmt/format.h>

namespace tern::mavlink {
namespace {

/// Periods of requests for HEARTBEAT, which an autopilot sends once a second by itself.
constexpr Duration kModePeriod{200'000}, kOldModePeriod{50'000};
/// Within this time after a HEARTBEAT its mode is current.
constexpr Duration kJustNow{50'000};

void request(Outbox& out) { out.request(kRequestMessage, {static_cast<float>(Heartbeat::kId)}); }

}  // namespace

/// Messages of an autopilot that is not known yet come from one that is there already, as after a restart in flight.
/// Its next HEARTBEAT may be a second away, so one is requested of every system that hears this.
void ModeArbiter::request_heartbeat(const Autopilot& autopilot, bool flies, UTime now, Outbox& out) {
  if (!autopilot.address()) {
    if (autopilot.strangers() > 0 && next_request_.take(now, kOldModePeriod)) request(out);
    return;
  }
  const bool old = autopilot.mode_is_old();
  if (old) next_request_.hurry(now, kOldModePeriod);
  if (!old && !flies && !commanded_) return;
  if (next_request_.take(now, old ? kOldModePeriod : kModePeriod)) request(out);
}

/// Commands are executed in order: the HEARTBEAT that is requested in front reports the mode that this command ends.
void ModeArbiter::command(const Autopilot& autopilot, UTime now, const std::string& wanted, std::uint16_t number,
                          const CommandParams& param, Outbox& out) {
  if (!out.may_command(now) || now - autopilot.mode_received() > kJustNow) return;
  request(out);
  out.command(now, number, param);
  commanded_ = {now, autopilot.mode(), wanted};
  next_request_.wait(now, kOldModePeriod);
}

bool ModeArbiter::watch(const Autopilot& autopilot, UTime now, Outbox& out) {
  if (!commanded_) return false;
  const std::string mode = autopilot.mode();
  const bool gives_back = pilots_ && pilots_->mode == commanded_->wanted;
  const bool is_before = mode == commanded_->before, is_wanted = !is_before && mode == commanded_->wanted;
  if (!is_before && !is_wanted) {
    pilots_ = {mode, autopilot.mode_command()};
    return true;
  }
  if (is_before && !gives_back) {
    if (now - commanded_->at > kCommandFlight) forget();
    return false;
  }
  if (is_wanted && (!pilots_ || gives_back)) {
    forget();
    return false;
  }
  if (is_wanted) {
    out.log(fmt::format("a pilot chose {} before the bridge commanded {}: commanding it again", pilots_->mode, mode));
  }
  command(autopilot, now, pilots_->mode, kDoSetMode, pilots_->command, out);
  return false;
}

void ModeArbiter::forget() {
  commanded_.reset();
  pilots_.reset();
}

bool ModeArbiter::is_taken_over(const Autopilot& autopilot) {
  if (!autopilot.follows()) {
    return !found_ || found_->mode != autopilot.mode() || found_->armed < autopilot.armed();
  }
  found_.reset();
  return false;
}

}  // namespace tern::mavlink
