#include "planner/optimization/joint_problem.h"

#include <algorithm>

#include "planner/optimization/ipopt_solver.h"

namespace tern {

JointProblem::JointProblem(const TrajectoryProblem& problem, const std::vector<SeparatedPair>& pairs,
                           const Points& initial_control_points)
    : convex_(make_convex_problem(problem, {}, initial_control_points)),
      base_(convex_),
      margin_(plane_margin(problem)) {
  const CurvePoints points(problem);
  start_.resize(convex_.variables() + 4 * static_cast<Eigen::Index>(pairs.size()));
  start_.head(convex_.variables()) = tern::free_variables(initial_control_points);
  for (const SeparatedPair& pair : pairs) add_block(problem, points, pair);
  add_patterns();
}

void JointProblem::add_block(const TrajectoryProblem& problem, const CurvePoints& points, const SeparatedPair& pair) {
  const PlaneConstraint& c = pair.plane;
  Block block;
  block.variable = free_variables() + 4 * static_cast<int>(blocks_.size());
  block.vertices = pair.hull.colwise() - problem.start.p;
  block.curve = points.hull(c.interval, c.u0, c.u1);
  for (AffinePoint& p : block.curve) p.offset -= problem.start.p;
  // Interval j depends on q_j … q_{j+3}, the free points j − 3 … j.
  block.first_point = std::max(c.interval - 3, 0);
  block.free_points = std::min(c.interval, points.free_points() - 1) - block.first_point + 1;
  start_.segment<3>(block.variable) = c.plane.n;
  start_[block.variable + 3] = c.plane.d + c.plane.n.dot(problem.start.p);
  blocks_.push_back(std::move(block));
}

void JointProblem::add_patterns() {
  jacobian_pattern_ = base_.jacobian_pattern();
  hessian_pattern_ = base_.hessian_pattern();
  auto row = static_cast<int>(base_.bounds().size());
  std::vector<double> bounds;
  for (const Block& b : blocks_) {
    for (Eigen::Index k = 0; k < b.vertices.cols(); ++k, ++row) {  // −n·c − d ≤ 0
      for (int a = 0; a < 4; ++a) jacobian_pattern_.add(row, b.variable + a);
      bounds.push_back(0.0);
    }
    for (int k = 0; k < 4; ++k, ++row) {  // n·q + d ≤ −margin
      for (int i = 0; i < 3 * b.free_points; ++i) jacobian_pattern_.add(row, 3 * b.first_point + i);
      for (int a = 0; a < 4; ++a) jacobian_pattern_.add(row, b.variable + a);
      bounds.push_back(-margin_);
    }
    for (int a = 0; a < 3; ++a) jacobian_pattern_.add(row, b.variable + a);  // |n|² ≤ 1
    bounds.push_back(1.0);
    ++row;
    for (int a = 0; a < 3; ++a) {
      for (int i = 0; i < b.free_points; ++i) hessian_pattern_.add(b.variable + a, 3 * (b.first_point + i) + a);
      hessian_pattern_.add(b.variable + a, b.variable + a);
    }
  }
  bounds_.resize(row);
  bounds_.head(base_.bounds().size()) = base_.bounds();
  bounds_.tail(static_cast<Eigen::Index>(bounds.size())) =
      Eigen::Map<const Eigen::VectorXd>(bounds.data(), static_cast<Eigen::Index>(bounds.size()));
}

double JointProblem::objective(const Eigen::VectorXd& x) const { return convex_.objective(x.head(free_variables())); }

Eigen::VectorXd JointProblem::gradient(const Eigen::VectorXd& x) const {
  Eigen::VectorXd g = Eigen::VectorXd::Zero(x.size());
  g.head(free_variables()) = base_.gradient(x.head(free_variables()));
  return g;
}

Eigen::VectorXd JointProblem::constraints(const Eigen::VectorXd& x) const {
  const FreeVariables points = x.head(free_variables());
  Eigen::VectorXd c(bounds_.size());
  Eigen::Index row = base_.bounds().size();
  c.head(row) = base_.constraints(points);
  for (const Block& b : blocks_) {
    const Vec3 n = x.segment<3>(b.variable);
    const double d = x[b.variable + 3];
    for (Eigen::Index k = 0; k < b.vertices.cols(); ++k) c[row++] = -n.dot(b.vertices.col(k)) - d;
    for (const AffinePoint& p : b.curve) c[row++] = n.dot(p.at(points)) + d;
    c[row++] = n.squaredNorm();
  }
  return c;
}

void JointProblem::jacobian(const Eigen::VectorXd& x, double* values) const {
  const FreeVariables points = x.head(free_variables());
  base_.jacobian(points, values);
  double* v = values + base_.jacobian_pattern().size();
  for (const Block& b : blocks_) {
    const Vec3 n = x.segment<3>(b.variable);
    for (Eigen::Index k = 0; k < b.vertices.cols(); ++k) {
      for (int a = 0; a < 3; ++a) *v++ = -b.vertices(a, k);
      *v++ = -1.0;
    }
    for (const AffinePoint& p : b.curve) {
      for (int i = 0; i < b.free_points; ++i) {
        for (int a = 0; a < 3; ++a) *v++ = p.weights[b.first_point + i] * n[a];
      }
      const Vec3 q = p.at(points);
      for (int a = 0; a < 3; ++a) *v++ = q[a];
      *v++ = 1.0;
    }
    for (int a = 0; a < 3; ++a) *v++ = 2.0 * n[a];
  }
}

void JointProblem::hessian(const Eigen::VectorXd& x, double factor, const double* multipliers, double* values) const {
  base_.hessian(x.head(free_variables()), factor, multipliers, values);
  double* v = values + base_.hessian_pattern().size();
  const double* multiplier = multipliers + base_.bounds().size();
  for (const Block& b : blocks_) {
    multiplier += b.vertices.cols();
    for (int a = 0; a < 3; ++a) {
      for (int i = 0; i < b.free_points; ++i) {
        double h = 0.0;
        for (std::size_t k = 0; k < 4; ++k) h += multiplier[k] * b.curve[k].weights[b.first_point + i];
        *v++ = h;
      }
      *v++ = 2.0 * multiplier[4];
    }
    multiplier += 5;
  }
}

ConvexSolution solve_joint(const JointProblem& problem, int max_iterations, const StopFunction& stop,
                           const Certify& certify) {
  ConvexSolution best;
  const Eigen::VectorXd x0 = problem.start();
  best.objective = problem.objective(x0);
  const auto keep_if_best = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& constraints) {
    const double objective = problem.objective(x);
    if (objective >= best.objective) return;
    if ((constraints - problem.bounds()).maxCoeff() > kJointTolerance) return;
    const FreeVariables points = x.head(problem.free_variables());
    if (!certify(points)) return;
    best.found = true;
    best.x = points;
    best.objective = objective;
  };
  const IpoptRun run = minimise_by_ipopt(problem, x0, max_iterations, stop, keep_if_best);
  best.solver_failed = run.failed;
  best.iterations = run.iterations;
  return best;
}

}  // namespace tern
