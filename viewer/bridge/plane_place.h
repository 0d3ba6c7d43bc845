// Where on a trajectory a plane of its certificate stands.
#pragma once

#include "core/world/horizon.h"

namespace tern {

/// Where the trajectory is in the middle of the plane's part of an interval, W. Intervals are counted from t_s
/// (lcmtypes/certificate_plane_t.lcm).
/// @param t_s  of the request that was answered; for a new trajectory its start
Vec3 place_of(const CertificatePlane& plane, const TimedSpline& trajectory, UTime t_s);

}  // namespace tern
