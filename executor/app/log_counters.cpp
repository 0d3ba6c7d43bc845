#include "executor/app/log_counters.h"

#include "core/world/names.h"
#include "runtime/log.h"

namespace tern {

void log_counters(const ExecutorCounters& counters, const HeadingCounters& headings) {
  log::info("requests {}, answered in time {}, unanswered {}, late {}, answered twice {}", counters.requests,
            counters.answered_in_time, counters.unanswered, counters.late(), counters.answered_twice());
  for (int k = 0; k < kVerdicts; ++k) {
    const auto verdict = static_cast<Verdict>(k);
    if (counters.of(verdict) > 0) log::info("plans {}: {}", to_string(verdict), counters.of(verdict));
  }
  for (int k = 0; k < kBreaches; ++k) {
    const auto breach = static_cast<Breach>(k);
    if (counters.of(breach) > 0) log::info("  of these for {}: {}", to_string(breach), counters.of(breach));
  }
  for (int k = 0; k < kHeadingVerdicts; ++k) {
    const auto verdict = static_cast<HeadingVerdict>(k);
    const std::int64_t count = headings.of(verdict);
    if (count > 0) log::info("headings {}: {}", to_string(verdict), count);
  }
}

void log_smallest_tube(double now_m, double before_m) {
  if (now_m != before_m) log::warn("the smallest tube is {:g} m now (was {:g})", now_m, before_m);
}

}  // namespace tern
