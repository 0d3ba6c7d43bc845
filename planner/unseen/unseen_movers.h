// The movers that `planner.unseen: passive` reckons with, and the window of the field that keeps them out.
#pragma once

#include "core/base/knobs.h"

namespace tern {

/// Whether plans keep out of the reach of movers that no sensor has seen.
enum class UnseenMode { Ignore, Passive };

/// The section `planner.unseen_movers`. An unseen mover is upright: it crosses the vehicle's height.
struct UnseenMovers {
  double max_speed_mps = 2.0;
  double least_width_m = 0.4;
  double clear_radius_m = 2.0;
  double wait_s = 2.0;
  bool looks = false;

  template <typename V>
  void visit(V& v) {
    v("max_speed_mps", max_speed_mps, Range{0.01, 100.0}, "an unseen mover is at most this fast, m/s");
    v("least_width_m", least_width_m, Range{0.0, 10.0}, "an unseen mover contains an upright square of this edge, m");
    v("clear_radius_m", clear_radius_m, Range{0.0, 7.0},
      "at take-off nobody unseen is within this distance of `uav.start`, m");
    v("wait_s", wait_s, Range{0.0, 1e6},
      "a vehicle that has been at rest for longer than this departs without a passively safe plan, s");
    v("looks", looks, "planned headings look where unseen movers may be, and around while the vehicle waits");
  }
};

/// Half the edge of the field's window about the newest sensor, m. A plan ends within r, and the field counts up to
/// UnseenField::kFarthest around it.
inline constexpr double kUnseenHalfWindow = 8.0;
/// Edge of the field's cells, m.
inline constexpr double kUnseenCell = 0.125;

}  // namespace tern
