#include "planner/start_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/box.h"
#include "core/geometry/distance.h"
#include "core/geometry/separation.h"
#include "core/world/body.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Halvings of the scale: an α of one metre is resolved to a micrometre.
constexpr int kHalvings = 20;

/// The distance of the body at p from an obstacle's box at one time, as a function of the scale of α or margin.
class StartDistance {
 public:
  /// @param body  its vertices at p, W. @param box  scratch memory
  StartDistance(const PlanningObstacle& o, const Points& body, double radius, UTime t, Points& box)
      : body_(body), box_(box), radius_(radius) {
    if (o.track == nullptr) {
      centre_ = o.box.center();
      half_ = 0.5 * o.map_box(0.0).sizes();
      alpha_ = Vec3::Constant(o.margin);
    } else {
      centre_ = o.track->motion.sample(std::clamp(t, o.track->motion.start, o.track->motion.end())).p;
      half_ = o.track->half_extents;
      alpha_ = o.alpha.of(*o.track, o.track->motion.locate(t).index);
    }
  }

  [[nodiscard]] bool clear(double scale, double slack) {
    box_ = box_corners(box_around(centre_, half_ + scale * alpha_));
    return distance(box_, body_) > radius_ + slack;
  }

  /// Returns the largest scale that leaves kStartSlack, or 0.
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

/// Returns whether the box around all pieces proves that the obstacle does not touch the body at p. If so, no distance
/// is computed.
/// @param reach  half-extents of the body, m
bool is_surely_clear(const PlanningObstacle& o, const Vec3& reach, const Vec3& p, UTime t) {
  if (o.boxes == nullptr || t < o.track->motion.start || t > o.boxes->end) return false;
  constexpr double kWithRounding = 2.0 * kTouchingTolerance;
  return !grown(o.boxes->whole, reach + Vec3::Constant(kWithRounding)).contains(p);
}

/// Returns the box of an obstacle with a scale of its α or margin. @pre it does not move
Box static_box(const PlanningObstacle& o, double scale) {
  if (o.track == nullptr) return o.map_box(scale * o.alpha.scale);
  return box_around(o.track->motion.pieces.front().coefficients.col(3),
                    o.track->half_extents + scale * o.alpha.of(*o.track, 0));
}

/// Cuts `side` at p if the body at p touches the box.
/// @param points  the body's vertices at p, W. @param bounds  of the body at p, W
/// @return whether it does
bool cut_at_touched_face(const Box& box, const Points& points, double radius, const Box& bounds, const Vec3& p,
                         Box& side) {
  const Vec3 above = bounds.min() - box.max();
  const Vec3 below = box.min() - bounds.max();
  Eigen::Index axis = 0;
  const double gap = above.cwiseMax(below).maxCoeff(&axis);
  if (std::abs(gap) > kTouchingTolerance) return false;
  if (distance(box_corners(box), points) > radius + kTouchingTolerance) return false;
  if (above[axis] >= below[axis]) {
    side.min()[axis] = std::max(side.min()[axis], p[axis]);
  } else {
    side.max()[axis] = std::min(side.max()[axis], p[axis]);
  }
  return true;
}

}  // namespace

Box leave_touched(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box side(Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity));
  const Points points = body.vertices.colwise() + p;
  const Box extent = body_box(body);
  const Box bounds(p + extent.min(), p + extent.max());
  std::erase_if(obstacles, [&](const PlanningObstacle& o) {
    const auto is_touched = [&](double scale) {
      return cut_at_touched_face(static_box(o, scale), points, body.radius, bounds, p, side);
    };
    return !o.moves() && (is_touched(1.0) || is_touched(0.0));
  });
  return side;
}

StartClearance clear_start(std::vector<PlanningObstacle>& obstacles, const Body& body, const Vec3& p, UTime t) {
  StartClearance result;
  const Points body_at_p = body.vertices.colwise() + p;
  Points box(3, 8);
  const Vec3 reach = body.half_extents();
  for (PlanningObstacle& o : obstacles) {
    if (!grown(o.box, reach).contains(p) || is_surely_clear(o, reach, p, t)) continue;
    if (o.track == nullptr && o.margin == 0.0) {
      box = box_corners(o.box);
      const bool clear = distance(box, body_at_p) > body.radius + kTouchingTolerance;
      result.collides = result.collides || !clear;
      continue;
    }
    StartDistance start(o, body_at_p, body.radius, t, box);
    if (start.clear(1.0, kTouchingTolerance)) continue;
    result.collides = result.collides || !start.clear(0.0, kTouchingTolerance);
    o.alpha.scale *= start.largest_scale();
    result.relaxed = true;
  }
  return result;
}

}  // namespace tern
