#include "planner/optimization/convex_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/base/random.h"
#include "planner/safety/thrust_set.h"
#include "tests/planner/optimization/random_problems.h"
#include "tests/support/flat_outputs.h"

namespace tern {
namespace {

using namespace support;

Eigen::VectorXd random_step(Rng& rng, Eigen::Index n, double size) {
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) d[i] = rng.uniform(-size, size);
  return d;
}

TEST(ConvexProblem, FreeVariablesAndControlPointsAreTheSameThing) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Instance instance = random_instance(seed);
    const Eigen::VectorXd x = free_variables(instance.initial);
    ASSERT_EQ(x.size(), 3 * (instance.problem.intervals - 2));
    const Points back = control_points_of(x, instance.problem);
    ASSERT_LE((back - instance.initial).cwiseAbs().maxCoeff(), 1e-12) << "seed " << seed;
    ASSERT_TRUE(ClampedSpline(back, instance.problem.interval_s()).ends_at_rest());
  }
}

TEST(ConvexProblem, TheObjectiveIsEquation4) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const TrajectoryProblem& p = instance.problem;
    const ConvexProblem convex = instance.convex();
    Rng rng(seed);
    const Eigen::VectorXd x = free_variables(instance.initial) + random_step(rng, convex.variables(), 1.0);
    const ClampedSpline spline(control_points_of(x, p), p.interval_s());
    double jerk = 0.0;
    for (int j = 0; j < p.intervals; ++j) jerk += spline.sample((j + 0.5) * p.interval_s()).j.squaredNorm();
    const double expected =
        p.weight_jerk * jerk + p.weight_goal * (spline.control_points().rightCols<1>() - p.goal).squaredNorm();
    ASSERT_NEAR(convex.objective(x), expected, 1e-7 * (1.0 + expected)) << "seed " << seed;
    ASSERT_NEAR(jerk_cost(spline.control_points(), p.interval_s()), jerk, 1e-7 * (1.0 + jerk)) << "seed " << seed;
  }
}

TEST(ConvexProblem, TheHessianIsSymmetricAndPositiveDefinite) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const ConvexProblem convex = random_instance(seed).convex();
    const double scale = convex.hessian.cwiseAbs().maxCoeff();
    ASSERT_LE((convex.hessian - convex.hessian.transpose()).cwiseAbs().maxCoeff(), 1e-14 * scale) << "seed " << seed;
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(convex.hessian).info(), Eigen::Success) << "seed " << seed;
  }
}

TEST(ConvexProblem, TheInitialPointIsAlwaysStrictlyInside) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const Instance instance = random_instance(seed);
    ASSERT_LT(instance.convex().worst_violation(free_variables(instance.initial)), -0.5 * kStartRoom)
        << "seed " << seed;
  }
}

TEST(ConvexProblem, TheInitialPointIsStrictlyInsideEvenWhereItBreaksBounds) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Instance instance = random_instance(seed);
    instance.problem.plan_limits.v_max *= 0.9;
    instance.problem.plan_limits.a_max *= 0.9;
    instance.problem.centre_box = grown(instance.problem.centre_box, Vec3::Constant(-0.01));
    instance.problem.sphere_radius *= 0.8;
    ASSERT_LT(instance.convex().worst_violation(free_variables(instance.initial)), -0.5 * kStartRoom)
        << "seed " << seed;
  }
}

/// Properties of every x within the problem's bounds, tested on the spline itself.
void expect_within(const Instance& instance, const Eigen::VectorXd& x, std::uint64_t seed) {
  const TrajectoryProblem& p = instance.problem;
  const ClampedSpline spline(control_points_of(x, p), p.interval_s());
  const ClampedSpline before(instance.initial, p.interval_s());
  constexpr double kRounding = 1e-7 + kStartRoom;
  for (int j = 0; j < p.intervals; ++j) {
    const MotionBounds now = motion_bounds(spline, j);
    const MotionBounds was = motion_bounds(before, j);
    for (int axis = 0; axis < 3; ++axis) {
      // The start's acceleration is no variable; bounds that the initial point breaks are widened to it.
      ASSERT_LE(now.a_max[axis],
                std::max({p.plan_limits.a_max[axis], was.a_max[axis], std::abs(p.start.a[axis])}) + kRounding)
          << "seed " << seed;
      ASSERT_LE(now.j_max[axis], std::max(p.plan_limits.j_max[axis], was.j_max[axis]) + 1e-4) << "seed " << seed;
    }
    const Points4 points = spline.minvo(j);
    ASSERT_LE((points.colwise() - p.start.p).colwise().norm().maxCoeff(), p.sphere_radius + kRounding)
        << "seed " << seed;
    const Box box(points.rowwise().minCoeff(), points.rowwise().maxCoeff());
    ASSERT_TRUE(grown(p.centre_box, Vec3::Constant(kRounding)).contains(box)) << "seed " << seed;
  }
  for (const PlaneConstraint& c : instance.planes) {
    const Points4 points = spline.minvo(c.interval, c.u0, c.u1);
    for (int k = 0; k < 4; ++k) {
      ASSERT_LE(c.plane.signed_distance(points.col(k)), -std::max(p.clearance, kPlaneMargin) + 1e-12)
          << "seed " << seed;
    }
  }
}

TEST(ConvexProblem, WhateverSatisfiesTheRowsKeepsTheLimitsAndThePlanes) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem convex = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    Rng rng(seed);
    for (int i = 0; i < 10; ++i) {
      // As far as the rows allow.
      const Eigen::VectorXd d = random_step(rng, x0.size(), 1.0);
      double low = 0.0;
      double high = 2.0;
      for (int k = 0; k < 40; ++k) {
        const double mid = 0.5 * (low + high);
        (convex.worst_violation(x0 + mid * d) <= 0.0 ? low : high) = mid;
      }
      if (low > 0.0) ++tried;
      expect_within(instance, x0 + low * d, seed);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tried, 100);
}

TEST(ConvexProblem, WhateverSatisfiesItAlsoKeepsThrustAndTilt) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    Instance instance = random_instance(seed);
    Rng rng(seed);
    const Dynamics dynamics = support::random_dynamics(rng);
    instance.problem.plan_limits.dynamics = dynamics;
    const ThrustSet set(dynamics);
    const TrajectoryProblem& p = instance.problem;
    const auto all_in_set = [&](const ClampedSpline& spline) {
      for (int j = 0; j + 1 < p.intervals; ++j) {
        const Vec3 a = spline.sample((j + 1) * p.interval_s()).a;
        if (!set.contains(a * (1.0 - 1e-5))) return false;
      }
      return true;
    };
    // Bounds are widened to a start that the search would not return; its neighbours keep only these.
    if (!all_in_set(ClampedSpline(instance.initial, p.interval_s()))) continue;
    const ConvexProblem convex = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    ASSERT_LT(convex.worst_violation(x0), -0.5 * kStartRoom) << "seed " << seed;
    for (int i = 0; i < 10; ++i) {
      const Eigen::VectorXd d = random_step(rng, x0.size(), 1.0);
      double low = 0.0;
      double high = 2.0;
      for (int k = 0; k < 40; ++k) {
        const double mid = 0.5 * (low + high);
        (convex.worst_violation(x0 + mid * d) <= 0.0 ? low : high) = mid;
      }
      if (low > 0.0) ++tried;
      ASSERT_TRUE(all_in_set(ClampedSpline(control_points_of(x0 + low * d, p), p.interval_s()))) << "seed " << seed;
    }
  }
  EXPECT_GE(tried, 100);
}

}  // namespace
}  // namespace tern
