// Where on a trajectory a separating plane is drawn.
#pragma once

#include "core/world/horizon.h"

namespace tern {

/// Returns the trajectory's position (W, m) in the middle of the plane's part of an interval. Intervals are counted
/// from t_s (lcmtypes/certificate_plane_t.lcm).
/// @param t_s  of the answered request; for a new trajectory its start
Vec3 place_of(const CertificatePlane& plane, const TimedSpline& trajectory, UTime t_s);

}  // namespace tern
