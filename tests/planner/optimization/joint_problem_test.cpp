#include "planner/optimization/joint_problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/distance.h"
#include "planner/optimization/barrier_solver.h"
#include "tests/planner/optimization/dense_derivatives.h"
#include "tests/planner/optimization/random_problems.h"

namespace tern {
namespace {

using namespace support;

constexpr int kEnough = 100;  // iterations

bool never() { return false; }
bool anything(const Eigen::VectorXd&) { return true; }

/// The first `count` seeds whose instance has planes.
std::vector<std::uint64_t> with_planes(int count) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; static_cast<int>(seeds.size()) < count; ++seed) {
    if (!random_instance(seed).planes.empty()) seeds.push_back(seed);
  }
  return seeds;
}

TEST(JointDerivatives, GradientJacobianAndHessianMatchFiniteDifferences) {
  for (const std::uint64_t seed : with_planes(10)) {
    const Instance instance = random_instance(seed);
    const JointProblem p(instance.problem, instance.pairs(), instance.initial);
    Rng rng(seed);
    Eigen::VectorXd x = p.start();
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += rng.uniform(-0.5, 0.5);
    Eigen::VectorXd multipliers(p.bounds().size());
    for (Eigen::Index i = 0; i < multipliers.size(); ++i) multipliers[i] = rng.uniform(-2.0, 2.0);
    const double factor = rng.uniform(0.0, 2.0);
    const DenseDerivatives at = dense_derivatives(p, x, factor, multipliers);
    const Eigen::VectorXd gradient = p.gradient(x);
    const auto lagrangian_gradient = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
      return factor * p.gradient(y) + dense_derivatives(p, y, factor, multipliers).jacobian.transpose() * multipliers;
    };
    constexpr double h = 1e-4;  // all functions are quadratic: central differences err by rounding alone
    for (Eigen::Index i = 0; i < x.size(); i += 1 + i / 20) {
      Eigen::VectorXd above = x;
      Eigen::VectorXd below = x;
      above[i] += h;
      below[i] -= h;
      const double slope = (p.objective(above) - p.objective(below)) / (2.0 * h);
      ASSERT_NEAR(gradient[i], slope, 1e-4 * (1.0 + std::abs(slope))) << "seed " << seed << " variable " << i;
      const Eigen::VectorXd column = (p.constraints(above) - p.constraints(below)) / (2.0 * h);
      const double scale = 1.0 + at.jacobian.cwiseAbs().maxCoeff();
      ASSERT_LE((at.jacobian.col(i) - column).cwiseAbs().maxCoeff(), 1e-6 * scale) << "seed " << seed;
      const Eigen::VectorXd curvature = (lagrangian_gradient(above) - lagrangian_gradient(below)) / (2.0 * h);
      const double bend = 1.0 + at.lagrangian_hessian.cwiseAbs().maxCoeff();
      ASSERT_LE((at.lagrangian_hessian.col(i) - curvature).cwiseAbs().maxCoeff(), 1e-5 * bend) << "seed " << seed;
    }
  }
}

TEST(JointProblem, StartsWithThePlanesItIsGivenAndWithinAllBounds) {
  for (const std::uint64_t seed : with_planes(20)) {
    const Instance instance = random_instance(seed);
    const JointProblem p(instance.problem, instance.pairs(), instance.initial);
    const Eigen::VectorXd x = p.start();
    ASSERT_EQ(x.size(), p.free_variables() + 4 * static_cast<Eigen::Index>(instance.planes.size()));
    EXPECT_EQ(x.head(p.free_variables()), free_variables(instance.initial));
    EXPECT_LE((p.constraints(x) - p.bounds()).maxCoeff(), kOptimizerMargin + 1e-9) << "seed " << seed;
    EXPECT_DOUBLE_EQ(p.objective(x), instance.convex().objective(free_variables(instance.initial)));
  }
}

TEST(SolveJoint, EveryOfferedPointHoldsEveryHullOff) {
  int offered = 0;
  for (const std::uint64_t seed : with_planes(4)) {
    const Instance instance = random_instance(seed);
    const TrajectoryProblem& problem = instance.problem;
    const JointProblem p(problem, instance.pairs(), instance.initial);
    const auto certify = [&](const Eigen::VectorXd& x) {
      ++offered;
      const ClampedSpline spline(control_points_of(x, problem), problem.interval_s());
      for (const SeparatedPair& pair : instance.pairs()) {
        const Points points = spline.minvo(pair.plane.interval, pair.plane.u0, pair.plane.u1);
        EXPECT_GE(distance(pair.hull, points), problem.clearance - 2.0 * kJointTolerance) << "seed " << seed;
      }
      return true;
    };
    (void)solve_joint(p, kEnough, never, certify);
  }
  EXPECT_GT(offered, 10);
}

TEST(SolveJoint, WithPlanesFreeToTurnTheCostIsLower) {
  int lower = 0;
  int solved = 0;
  for (const std::uint64_t seed : with_planes(6)) {
    const Instance instance = random_instance(seed);
    const JointProblem p(instance.problem, instance.pairs(), instance.initial);
    const ConvexSolution joint = solve_joint(p, kEnough, never, anything);
    const ConvexSolution fixed = BarrierSolver().solve(instance.convex(), free_variables(instance.initial), 60, never);
    if (!joint.found) continue;
    ++solved;
    EXPECT_LE(joint.objective, fixed.objective * 1.02 + 1e-4) << "seed " << seed;
    if (joint.objective < fixed.objective * 0.999) ++lower;
  }
  EXPECT_GE(solved, 5);
  EXPECT_GE(lower, 1);
}

TEST(SolveJoint, WhatIsNotCertifiedIsNotFound) {
  const Instance instance = random_instance(with_planes(1)[0]);
  const JointProblem p(instance.problem, instance.pairs(), instance.initial);
  EXPECT_FALSE(solve_joint(p, kEnough, never, [](const Eigen::VectorXd&) { return false; }).found);
}

TEST(SolveJoint, StoppedAtAnyIterationItKeepsTheBestSoFar) {
  const Instance instance = random_instance(with_planes(1)[0]);
  const JointProblem p(instance.problem, instance.pairs(), instance.initial);
  double last = p.objective(p.start());
  for (int n = 0; n < 20; n += 4) {
    int asked = 0;
    const ConvexSolution stopped = solve_joint(
        p, kEnough, [&] { return asked++ >= n; }, anything);
    EXPECT_FALSE(stopped.solver_failed);
    EXPECT_LE(stopped.iterations, n);
    EXPECT_LE(stopped.objective, last);
    last = stopped.objective;
  }
}

}  // namespace
}  // namespace tern
