// Periodic deadlines that keep their phase and skip what was missed.
#pragma once

#include "core/base/time.h"

namespace tern {

/// Returns the first of due + period, due + 2·period, … that is after `now`. A process that was held up skips the
/// missed ticks.
/// @pre due ≤ now, period > 0
constexpr UTime next_tick(UTime due, Duration period, UTime now) {
  return due + period * ((now - due).us / period.us + 1);
}

}  // namespace tern
