#include "planner/optimization/ipopt_solver.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/planner/optimization/dense_derivatives.h"
#include "tests/planner/optimization/random_problems.h"

namespace tern {
namespace {

using namespace support;

bool never() { return false; }

TEST(IpoptDerivatives, GradientJacobianAndHessianMatchFiniteDifferences) {
  int with_planes = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Instance instance = random_instance(seed);
    if (!instance.planes.empty()) ++with_planes;
    const ConvexProblem p = instance.convex();
    Rng rng(seed);
    Eigen::VectorXd x = free_variables(instance.initial);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += rng.uniform(-0.5, 0.5);
    Eigen::VectorXd multipliers(p.row_count() + p.spheres());
    for (Eigen::Index i = 0; i < multipliers.size(); ++i) multipliers[i] = rng.uniform(-2.0, 2.0);
    const double factor = rng.uniform(0.0, 2.0);
    const ConvexAsNonlinear nonlinear(p);
    const DenseDerivatives at = dense_derivatives(nonlinear, x, factor, multipliers);
    const Eigen::VectorXd gradient = p.hessian * x + p.gradient;
    const auto lagrangian_gradient = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
      return factor * (p.hessian * y + p.gradient) +
             dense_derivatives(nonlinear, y, factor, multipliers).jacobian.transpose() * multipliers;
    };
    constexpr double h = 1e-4;  // all functions are quadratic: central differences err by rounding alone
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(x.size());
      step[i] = h;
      const Eigen::VectorXd above = x + step;
      const Eigen::VectorXd below = x - step;
      const double slope = (p.objective(above) - p.objective(below)) / (2.0 * h);
      ASSERT_NEAR(gradient[i], slope, 1e-5 * (1.0 + std::abs(slope) + p.constant)) << "seed " << seed;
      const Eigen::VectorXd column = (nonlinear.constraints(above) - nonlinear.constraints(below)) / (2.0 * h);
      const double scale = 1.0 + at.jacobian.cwiseAbs().maxCoeff();
      ASSERT_LE((at.jacobian.col(i) - column).cwiseAbs().maxCoeff(), 1e-6 * scale) << "seed " << seed;
      const Eigen::VectorXd curvature = (lagrangian_gradient(above) - lagrangian_gradient(below)) / (2.0 * h);
      const double bend = 1.0 + at.lagrangian_hessian.cwiseAbs().maxCoeff();
      ASSERT_LE((at.lagrangian_hessian.col(i) - curvature).cwiseAbs().maxCoeff(), 1e-5 * bend) << "seed " << seed;
    }
  }
  EXPECT_GT(with_planes, 5);
}

TEST(IpoptDerivatives, ConstraintsAreTheRowsAndTheSquaredDistancesFromTheSpheresCentre) {
  const Instance instance = random_instance(3);
  const ConvexProblem p = instance.convex();
  const Eigen::VectorXd x = free_variables(instance.initial);
  const Eigen::VectorXd constraints = ConvexAsNonlinear(p).constraints(x);
  for (int r = 0; r < p.row_count(); ++r) {
    EXPECT_NEAR(constraints[r], Eigen::Map<const Eigen::VectorXd>(p.row(r), x.size()).dot(x), 1e-9);
    EXPECT_LE(constraints[r], p.bounds[static_cast<std::size_t>(r)]);
  }
  EXPECT_LE(constraints.tail(p.spheres()).maxCoeff(), p.sphere_radius2);
}

/// Oracle: Eq. 4 without constraints as linear least squares, its residuals read off the spline.
Eigen::VectorXd residuals(const TrajectoryProblem& p, const Eigen::VectorXd& x) {
  const ClampedSpline spline(control_points_of(x, p), p.interval_s());
  Eigen::VectorXd r(3 * p.intervals + 3);
  for (int j = 0; j < p.intervals; ++j) {
    r.segment<3>(3 * j) = std::sqrt(p.weight_jerk) * spline.sample((j + 0.5) * p.interval_s()).j;
  }
  r.tail<3>() = std::sqrt(p.weight_goal) * (spline.control_points().rightCols<1>() - p.goal);
  return r;
}

Eigen::VectorXd least_squares(const TrajectoryProblem& p, Eigen::Index n) {
  const Eigen::VectorXd origin = residuals(p, Eigen::VectorXd::Zero(n));
  Eigen::MatrixXd a(origin.size(), n);
  for (Eigen::Index i = 0; i < n; ++i) a.col(i) = residuals(p, Eigen::VectorXd::Unit(n, i)) - origin;
  return a.colPivHouseholderQr().solve(-origin);
}

TEST(SolveByIpopt, InAnEmptyWorldFindsTheClosedFormLeastSquaresAnswer) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Instance instance = random_instance(seed);
    TrajectoryProblem& p = instance.problem;
    instance.planes.clear();
    p.start.p *= 0.1;
    instance.initial = control_points_of(p.start.p.replicate(p.intervals - 2, 1), p);
    p.goal = p.start.p + 0.2 * (p.goal - instance.initial.col(0));
    p.plan_limits.v_max = p.plan_limits.a_max = p.plan_limits.j_max = Vec3::Constant(1e6);
    p.sphere_radius = 1e3;
    p.centre_box = Box(Vec3::Constant(-1e4), Vec3::Constant(1e4));
    const ConvexSolution solution = solve_by_ipopt(instance.convex(), free_variables(instance.initial), 200, never);
    ASSERT_TRUE(solution.found);
    EXPECT_FALSE(solution.solver_failed);
    const Eigen::VectorXd exact = least_squares(p, solution.x.size());
    const double best = residuals(p, exact).squaredNorm();
    EXPECT_LE(solution.objective, best + 1e-5 * (1.0 + best)) << "seed " << seed;
    EXPECT_GE(solution.objective, best - 1e-6 * (1.0 + best)) << "seed " << seed;
    EXPECT_LE((solution.x - exact).cwiseAbs().maxCoeff(), 0.01) << "seed " << seed;
  }
}

TEST(SolveByIpopt, EveryAnswerSatisfiesEveryConstraintAndIsNoWorseThanItsStart) {
  int improved = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    const ConvexSolution solution = solve_by_ipopt(p, x0, 60, never);
    ASSERT_TRUE(solution.found) << "seed " << seed;
    ASSERT_LE(p.worst_violation(solution.x), 0.0) << "seed " << seed;
    ASSERT_EQ(solution.objective, p.objective(solution.x));
    ASSERT_LE(solution.objective, p.objective(x0));
    if (solution.objective < 0.99 * p.objective(x0)) ++improved;
  }
  EXPECT_GT(improved, 70);
}

TEST(SolveByIpopt, TheOptimumHasNoFeasibleNeighbourThatIsBetter) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const ConvexSolution solution = solve_by_ipopt(p, free_variables(instance.initial), 200, never);
    ASSERT_TRUE(solution.found);
    if (solution.solver_failed) continue;
    Rng rng(seed);
    for (int i = 0; i < 300; ++i) {
      Eigen::VectorXd d(solution.x.size());
      for (Eigen::Index k = 0; k < d.size(); ++k) d[k] = rng.normal();
      const Eigen::VectorXd y = solution.x + d * std::pow(10.0, rng.uniform(-4.0, -1.0));
      if (p.worst_violation(y) > 0.0) continue;
      ASSERT_GE(p.objective(y), solution.objective - 1e-4 * (1.0 + solution.objective)) << "seed " << seed;
    }
  }
}

TEST(SolveByIpopt, WithPlanesTheCurveStaysOnItsSide) {
  int planes = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const Instance instance = random_instance(seed);
    if (instance.planes.empty()) continue;
    const ConvexSolution solution = solve_by_ipopt(instance.convex(), free_variables(instance.initial), 60, never);
    ASSERT_TRUE(solution.found);
    const ClampedSpline spline(control_points_of(solution.x, instance.problem), instance.problem.interval_s());
    for (const PlaneConstraint& c : instance.planes) {
      ++planes;
      const Points4 points = spline.minvo(c.interval, c.u0, c.u1);
      for (int k = 0; k < 4; ++k) {
        ASSERT_LE(c.plane.signed_distance(points.col(k)), -std::max(instance.problem.clearance, kPlaneMargin) + 1e-12)
            << "seed " << seed;
      }
    }
  }
  EXPECT_GT(planes, 200);
}

TEST(SolveByIpopt, StoppedAtAnyIterationItHasAFeasibleAnswer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Instance instance = random_instance(seed);
    const ConvexProblem p = instance.convex();
    const Eigen::VectorXd x0 = free_variables(instance.initial);
    double last = p.objective(x0);
    for (int n = 0; n < 12; n += 2) {
      int asked = 0;
      const ConvexSolution stopped = solve_by_ipopt(p, x0, 60, [&] { return asked++ >= n; });
      ASSERT_TRUE(stopped.found) << "seed " << seed << " after " << n;
      EXPECT_FALSE(stopped.solver_failed);
      EXPECT_LE(stopped.iterations, n);
      ASSERT_LE(p.worst_violation(stopped.x), 0.0);
      ASSERT_LE(stopped.objective, last);
      last = stopped.objective;
    }
    const ConvexSolution limited = solve_by_ipopt(p, x0, 1, never);
    ASSERT_TRUE(limited.found);
    EXPECT_FALSE(limited.solver_failed);
    EXPECT_LE(p.worst_violation(limited.x), 0.0);
  }
}

TEST(SolveByIpopt, AFailureOfTheSolverIsToldAndTheFeasibleStartIsKept) {
  const Instance instance = random_instance(1);
  ConvexProblem p = instance.convex();
  const Eigen::VectorXd x0 = free_variables(instance.initial);
  p.hessian(0, 0) = INFINITY;  // a number that Ipopt refuses as soon as it sees it
  const ConvexSolution solution = solve_by_ipopt(p, x0, 60, never);
  EXPECT_TRUE(solution.solver_failed);
  ASSERT_TRUE(solution.found);
  EXPECT_LE(p.worst_violation(solution.x), 0.0);
}

TEST(SolveByIpopt, WithoutAFeasiblePointThereIsNoAnswer) {
  const Instance instance = random_instance(2);
  ConvexProblem p = instance.convex();
  const FreeVariables first = FreeVariables::Unit(p.variables(), 0);
  const double bound = free_variables(instance.initial)[0] - 0.01;
  p.add_row(first, bound);
  p.add_row(-first, -bound - 0.02);
  EXPECT_FALSE(solve_by_ipopt(p, free_variables(instance.initial), 60, never).found);
}

TEST(SolveByIpopt, SolvesTheSameProblemToTheSameBits) {
  const Instance instance = random_instance(7);
  const Eigen::VectorXd x0 = free_variables(instance.initial);
  const ConvexSolution first = solve_by_ipopt(instance.convex(), x0, 60, never);
  (void)solve_by_ipopt(random_instance(8).convex(), free_variables(random_instance(8).initial), 60, never);
  const ConvexSolution second = solve_by_ipopt(instance.convex(), x0, 60, never);
  EXPECT_EQ(first.x, second.x);
  EXPECT_EQ(first.iterations, second.iterations);
}

}  // namespace
}  // namespace tern
