#include "planner/optimization/trajectory_problem.h"

#include <stdexcept>
#include <string>

namespace tern {
namespace {

AffinePoint scaled(AffinePoint p, double factor) {
  p.weights *= factor;
  p.offset *= factor;
  return p;
}

/// Returns M with (u³, u², u, 1)ᵀ = M (s³, s², s, 1)ᵀ for u = u0 + s(u1 − u0).
Eigen::Matrix4d to_part(double u0, double u1) {
  const double w = u1 - u0;
  const double a = u0;
  Eigen::Matrix4d m;
  m << w * w * w, 3 * a * w * w, 3 * a * a * w, a * a * a,  //
      0, w * w, 2 * a * w, a * a,                           //
      0, 0, w, a,                                           //
      0, 0, 0, 1;
  return m;
}

}  // namespace

Vec3 AffinePoint::at(const FreeVariables& x) const {
  Vec3 p = offset;
  for (Eigen::Index i = 0; i < weights.size(); ++i) p += weights[i] * x.segment<3>(3 * i);
  return p;
}

CurvePoints::CurvePoints(const HorizonProblem& problem)
    : problem_(problem),
      basis_(spline_basis(problem.intervals)),
      free_(problem.intervals - 2),
      start_(start_control_points(problem.start, problem.interval_s())) {
  if (problem.intervals < 4 || problem.intervals > kMaxPlanIntervals) {
    throw std::invalid_argument("CurvePoints: " + std::to_string(problem.intervals) + " intervals, not 4 to " +
                                std::to_string(kMaxPlanIntervals));
  }
}

AffinePoint CurvePoints::combination(int j, const Eigen::Vector4d& c) const {
  AffinePoint p{FreeWeights::Zero(free_), Vec3::Zero()};
  for (int k = 0; k < 4; ++k) {
    const int l = j + k;
    if (l < 3)
      p.offset += c[k] * start_.col(l);
    else
      p.weights[std::min(l - 3, free_ - 1)] += c[k];  // q_{n-2} = q_{n-1} = q_n
  }
  return p;
}

std::array<AffinePoint, 4> CurvePoints::minvo(int j) const {
  const Eigen::Matrix4d& weights = basis_.position_minvo(j);
  return {combination(j, weights.col(0)), combination(j, weights.col(1)), combination(j, weights.col(2)),
          combination(j, weights.col(3))};
}

std::array<AffinePoint, 4> CurvePoints::hull(int j, double u0, double u1) const {
  const HullBasis form = problem_.hull_basis;
  const bool whole = u0 == 0.0 && u1 == 1.0;
  const Eigen::Matrix4d weights = whole ? hull_of_interval(basis_, form, j)
                                        : Eigen::Matrix4d(basis_.power(j) * to_part(u0, u1) * hull_inverse_3(form));
  return {combination(j, weights.col(0)), combination(j, weights.col(1)), combination(j, weights.col(2)),
          combination(j, weights.col(3))};
}

std::array<AffinePoint, 3> CurvePoints::velocity_hull(int j) const {
  const Eigen::Matrix<double, 4, 3> weights =
      velocity_hull_of_interval(basis_, problem_.hull_basis, j) / problem_.interval_s();
  return {combination(j, weights.col(0)), combination(j, weights.col(1)), combination(j, weights.col(2))};
}

AffinePoint CurvePoints::velocity_control_point(int l) const {
  AffinePoint p{FreeWeights::Zero(free_), Vec3::Zero()};
  const double scale = 1.0 / problem_.interval_s();
  p.weights[std::min(l - 2, free_ - 1)] += scale;
  if (l < 3)
    p.offset = -scale * start_.col(l);
  else
    p.weights[std::min(l - 3, free_ - 1)] -= scale;
  return p;
}

AffinePoint CurvePoints::acceleration_at_end(int j) const {
  const double dt = problem_.interval_s();
  return scaled(combination(j, basis_.acceleration_ends(j).col(1)), 1.0 / (dt * dt));
}

AffinePoint CurvePoints::jerk(int j) const {
  const double dt = problem_.interval_s();
  return scaled(combination(j, basis_.jerk(j)), 1.0 / (dt * dt * dt));
}

FreeVariables free_variables(const Points& control_points) {
  const Eigen::Index n = control_points.cols() - 5;
  return Eigen::Map<const Eigen::VectorXd>(control_points.data() + 9, 3 * n);
}

Points control_points_of(const FreeVariables& x, const HorizonProblem& problem) {
  Points q(3, problem.intervals + 3);
  q.leftCols<3>() = start_control_points(problem.start, problem.interval_s());
  const Eigen::Index n = x.size() / 3;
  q.middleCols(3, n) = Eigen::Map<const Points>(x.data(), 3, n);
  q.col(n + 3) = q.col(n + 2);
  q.col(n + 4) = q.col(n + 2);
  return q;
}

double jerk_cost(const Points& control_points, double interval_s) {
  const int intervals = static_cast<int>(control_points.cols()) - 3;
  const SplineBasis& basis = spline_basis(intervals);
  double sum = 0.0;
  for (int j = 0; j < intervals; ++j) {
    const Points4 window = control_points.middleCols<4>(j);
    sum += (window * basis.jerk(j)).squaredNorm();
  }
  const double dt3 = interval_s * interval_s * interval_s;
  return sum / (dt3 * dt3);
}

}  // namespace tern
