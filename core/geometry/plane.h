// A separating plane (Eq. 1 of the paper): n·x + d ≥ 0 on the obstacle's side, n·x + d < 0 on the vehicle's side.
#pragma once

#include "core/base/types.h"

namespace tern {

/// The oriented plane {x : n·x + d = 0} in W.
struct Plane {
  Vec3 n = Vec3(1.0, 0.0, 0.0);  ///< unit normal, towards the obstacle
  double d = 0.0;                ///< offset, m

  /// Returns the signed distance of p, m; positive on the obstacle's side.
  [[nodiscard]] double signed_distance(const Vec3& p) const { return n.dot(p) + d; }
};

}  // namespace tern
