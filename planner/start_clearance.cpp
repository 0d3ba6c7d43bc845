#include "planner/start_clearance.h"

#include <algorithm>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/geometry/separation.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Halvings of the scale: α of a metre to a micrometre.
constexpr int kHalvings = 20;

/// How far the body at p is from the track's box at time t when its α is scaled by s.
class StartDistance {
 public:
  /// @param body  its vertices about p; @param box  memory
  StartDistance(const Track& track, const AlphaCount& count, const Points& body, double radius, UTime t, Points& box)
      : body_(body),
        box_(box),
        radius_(radius),
        centre_(track.motion.sample(std::clamp(t, track.motion.start, track.motion.end())).p),
        half_(track.half_extents),
        alpha_(count.of(track, track.motion.locate(t).index)) {}

  [[nodiscard]] bool clear(double scale, double slack) {
    box_ = box_corners(box_around(centre_, half_ + scale * alpha_));
    return distance(box_, body_) > radius_ + slack;
  }

  /// The largest scale that leaves kStartSlack; 0 when none does.
  [[nodiscard]] double largest_scale() {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (clear(middle, kStartSlack) ? low : high) = middle;
    }
    return low;
  }

 private:
  const Points& body_;
  Points& box_;
  double radius_;
  Vec3 centre_, half_, alpha_;
};

}  // namespace

StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t) {
  StartClearance result;
  const Points body_at_p = body.vertices.colwise() + p;
  Points box(3, 8);
  for (PlanningObstacle& o : obstacles) {
    if (!grown(o.box, body.half_extents()).contains(p)) continue;
    if (o.track == nullptr) {
      box = box_corners(o.box);
      const bool clear = distance(box, body_at_p) > body.radius + kTouchingTolerance;
      result.collides = result.collides || !clear;
      continue;
    }
    StartDistance start(*o.track, o.alpha, body_at_p, body.radius, t, box);
    if (start.clear(1.0, kTouchingTolerance)) continue;
    result.collides = result.collides || !start.clear(0.0, kTouchingTolerance);
    o.alpha.scale *= start.largest_scale();
    result.relaxed = true;
  }
  return result;
}

}  // namespace tern
