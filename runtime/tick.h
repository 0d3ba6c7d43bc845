// A beat that keeps its phase and never catches up.
#pragma once

#include "core/base/time.h"

namespace tern {

/// The first of due + period, due + 2·period … that is after `now`: a process that was held up skips what it missed.
/// @pre due ≤ now, period > 0
constexpr UTime next_tick(UTime due, Duration period, UTime now) {
  return due + period * ((now - due).us / period.us + 1);
}

}  // namespace tern
