#include "planner/start_clearance.h"

#include <algorithm>

namespace tern {
namespace {

/// Clear by this much at the start, m: a first interval's hull needs a little more than touching.
constexpr double kStartSlack = 1e-3;

/// The α in force at t.
const Vec3& alpha_at(const Track& track, UTime t) { return track.alpha[track.motion.locate(t).index]; }

}  // namespace

StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t) {
  StartClearance result;
  const Vec3 half = body.half_extents();
  for (PlanningObstacle& o : obstacles) {
    if (o.track == nullptr) {
      result.collides = result.collides || grown(o.box, half).contains(p);
      continue;
    }
    if (!grown(o.box, half).contains(p)) continue;
    const Track& track = *o.track;
    const Vec3 centre = track.motion.sample(std::clamp(t, track.motion.start, track.motion.end())).p;
    const Vec3 alpha = alpha_at(track, t);
    const Vec3 room = (p - centre).cwiseAbs() - track.half_extents - half - Vec3::Constant(kStartSlack);
    if ((room.array() > alpha.array()).any()) continue;
    double scale = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (alpha[axis] > 0.0)
        scale = std::max(scale, room[axis] / alpha[axis]);
      else if (room[axis] > 0.0)
        scale = 1.0;
    }
    if (scale < 0.0) result.collides = true;
    o.alpha_scale = std::clamp(scale, 0.0, 1.0);
    result.relaxed = result.relaxed || o.alpha_scale < 1.0;
  }
  return result;
}

}  // namespace tern
