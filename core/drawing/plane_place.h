// Where on a trajectory a separating plane is drawn.
#pragma once

#include "core/world/horizon.h"

namespace tern {

/// Returns the trajectory's position (W, m) in the middle of the plane's part of an interval. Interval 0 is the rest,
/// from t_s on, of the interval that contains t_s (lcmtypes/certificate_plane_t.lcm).
/// @param t_s  the time t_s of the answered request; a new trajectory starts at it
Vec3 place_of(const CertificatePlane& plane, const TimedSpline& trajectory, UTime t_s);

}  // namespace tern
