#include "launcher/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace tern {

Duration Backoff::next(Duration run) {
  constexpr Duration kFirst{10'000}, kLast{1'000'000}, kLongRun{5'000'000};
  delay_ = delay_ == Duration{} || run >= kLongRun ? kFirst : std::min(delay_ * 2, kLast);
  return delay_;
}

bool is_permanent(const ProcessEnd& end) {
  constexpr std::array kFinal{0, 2, 3, 126, 127};
  return end.signal == 0 && std::find(kFinal.begin(), kFinal.end(), end.exit_code) != kFinal.end();
}

int shell_code(const ProcessEnd& end) { return end.signal == 0 ? end.exit_code : kExitSignalled + end.signal; }

std::string to_text(const ProcessEnd& end) {
  if (end.signal == 0) return fmt::format("exit code {}", end.exit_code);
  const char* const name = sigabbrev_np(end.signal);
  return name != nullptr ? fmt::format("signal {}", name) : fmt::format("signal {}", end.signal);
}

int code_after_flight(int monitor_code, bool has_summary) {
  if (monitor_code == kExitIncomplete) return kExitIncomplete;
  return has_summary && monitor_code <= kExitFailed ? monitor_code : kExitFailed;
}

int code_after_audit(int code, int audit_code) {
  constexpr int kPartOnly = 3, kNotJudged = 4;
  if (audit_code == 0) return code;
  if (audit_code == kPartOnly || audit_code == kNotJudged) return code == 0 ? kExitIncomplete : code;
  // A disk that is too full for the recording is too full for the audit as well.
  if (audit_code != 1) return code == kExitIncomplete ? code : kExitFailed;
  return code == 1 || code == kExitFailed ? code : kExitBroken;
}

}  // namespace tern
