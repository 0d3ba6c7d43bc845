// Random instances of Eq. 4, with a start that a search could have given.
#pragma once

#include "core/geometry/box.h"
#include "core/geometry/separation.h"
#include "planner/optimization/joint_problem.h"
#include "tests/support/planner_worlds.h"
#include "tests/support/random_splines.h"

namespace tern::support {

struct Instance {
  TrajectoryProblem problem;
  std::vector<PlaneConstraint> planes;
  std::vector<Points> hulls;  ///< the obstacle of each plane
  Points initial;             ///< control points

  [[nodiscard]] ConvexProblem convex() const { return make_convex_problem(problem, planes, initial); }
  [[nodiscard]] std::vector<SeparatedPair> pairs() const {
    std::vector<SeparatedPair> pairs;
    for (std::size_t k = 0; k < planes.size(); ++k) pairs.push_back({planes[k], hulls[k]});
    return pairs;
  }
};

/// Makes box obstacles beside the initial trajectory, each separated from the intervals and parts near it.
inline void add_planes(Rng& rng, Instance& instance) {
  const ClampedSpline spline(instance.initial, instance.problem.interval_s());
  for (int i = 0; i < 6; ++i) {
    const Vec3 near = spline.sample(rng.uniform() * spline.duration_s()).p + support::random_vector(rng, 1.0);
    const Points box = box_corners(Box(near, near + Vec3::Constant(0.3)));
    for (int j = 0; j < spline.intervals(); ++j) {
      const int parts = 1 << support::random_integer(rng, 0, 2);
      const int part = support::random_integer(rng, 0, parts - 1);
      const double u0 = static_cast<double>(part) / parts;
      const double u1 = (part + 1.0) / parts;
      const auto found = separate(box, Points(spline.minvo(j, u0, u1)), instance.problem.clearance);
      if (!found) continue;
      instance.planes.push_back({j, u0, u1, found->plane});
      instance.hulls.push_back(box);
    }
  }
}

/// Draws a problem: J from 4 to 9, a start at rest or moving, sometimes a jerk limit and a flight box, planes in half.
inline Instance random_instance(std::uint64_t seed) {
  Rng rng(seed);
  for (;;) {
    Instance instance;
    TrajectoryProblem& p = instance.problem;
    p.intervals = support::random_integer(rng, 4, 9);
    p.interval = Duration::from_seconds(rng.uniform(0.1, 0.35));
    p.plan_limits.v_max *= 0.99;
    if (rng.uniform() < 0.3) p.plan_limits.j_max = Vec3::Constant(rng.uniform(60.0, 300.0));
    p.start.p = support::random_vector(rng, 50.0);
    if (rng.uniform() < 0.7) {
      p.start.v = support::random_vector(rng, 4.0);
      p.start.a = support::random_vector(rng, 4.0);
    }
    const auto way = support::random_way_to_rest(rng, p.start, p.plan_limits, p.intervals, p.interval_s());
    if (!way) continue;
    instance.initial = *way;
    p.clearance = rng.uniform() < 0.5 ? 0.1 : 0.0;
    p.weight_jerk = 2e-6;
    p.goal = p.start.p + support::random_vector(rng, 3.0);
    p.centre_box = Box(Vec3::Constant(-1e4), Vec3::Constant(1e4));
    double farthest = 0.0;
    Box held;
    const ClampedSpline spline(instance.initial, p.interval_s());
    for (int j = 0; j < p.intervals; ++j) {
      const Points4 points = spline.minvo(j);
      farthest = std::max(farthest, (points.colwise() - p.start.p).colwise().norm().maxCoeff());
      for (int k = 0; k < 4; ++k) held.extend(Vec3(points.col(k)));
    }
    p.sphere_radius = farthest * 1.001 + rng.uniform(0.0, 3.0);
    if (rng.uniform() < 0.4) p.centre_box = grown(held, Vec3::Constant(rng.uniform(0.0, 0.5)));
    if (rng.uniform() < 0.5) add_planes(rng, instance);
    return instance;
  }
}

}  // namespace tern::support
