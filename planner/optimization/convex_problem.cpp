#include "planner/optimization/convex_problem.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// Limits farther away than this share of themselves are left out: an axis that x0 leaves at rest may go to half its
/// limit.
constexpr double kLimitReach = 1.5;

class Builder {
 public:
  Builder(const TrajectoryProblem& problem, const Eigen::VectorXd& x0)
      : problem_(problem), x0_(x0), curve_(problem), free_(problem.intervals - 2) {}

  /// direction·point ≤ limit; dropped when it does not depend on x, or when x0 is farther than `reach` from it.
  void add_row(const AffinePoint& point, const Vec3& direction, double limit, double reach) {
    if (point.fixed()) return;
    Eigen::VectorXd row(3 * free_);
    for (int i = 0; i < free_; ++i) row.segment<3>(3 * i) = point.weights[i] * direction;
    const double bound = limit - direction.dot(point.offset);
    const double at_x0 = row.dot(x0_);
    if (bound - at_x0 > reach) return;
    rows_.push_back(std::move(row));
    bounds_.push_back(std::max(bound, at_x0));
  }

  void add_symmetric(const AffinePoint& point, const Vec3& limits) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(limits[axis])) continue;
      add_row(point, Vec3::Unit(axis), limits[axis], kLimitReach * limits[axis]);
      add_row(point, -Vec3::Unit(axis), limits[axis], kLimitReach * limits[axis]);
    }
  }

  void add_planes(const std::vector<PlaneConstraint>& planes) {
    const double margin = plane_margin(problem_);
    for (const PlaneConstraint& c : planes) {
      for (const AffinePoint& p : curve_.hull(c.interval, c.u0, c.u1))
        add_row(p, c.plane.n, -c.plane.d - margin, problem_.reach);
    }
  }

  /// The first two intervals are bounded by their velocity control points, because their hull points hang almost wholly
  /// on the start, which may move at the limit.
  void add_limits() {
    for (int j = 0; j < problem_.intervals; ++j) {
      if (j < 2) {
        add_symmetric(curve_.velocity_control_point(j + 2), problem_.limits.v_max);
      } else {
        for (const AffinePoint& p : curve_.velocity_hull(j)) add_symmetric(p, problem_.limits.v_max);
      }
      if (j + 1 < problem_.intervals) add_symmetric(curve_.acceleration_at_end(j), problem_.limits.a_max);
      add_symmetric(curve_.jerk(j), problem_.limits.j_max);
    }
  }

  /// Only the sides that cut the sphere: the others follow from it, and each row costs Ipopt time.
  void add_box_rows(const AffinePoint& p) {
    const Vec3 above = problem_.centre_box.max() - problem_.start.p;
    const Vec3 below = problem_.start.p - problem_.centre_box.min();
    for (int axis = 0; axis < 3; ++axis) {
      if (above[axis] < problem_.sphere_radius)
        add_row(p, Vec3::Unit(axis), problem_.centre_box.max()[axis], problem_.reach);
      if (below[axis] < problem_.sphere_radius)
        add_row(p, -Vec3::Unit(axis), -problem_.centre_box.min()[axis], problem_.reach);
    }
  }

  void add_boxes_and_spheres(ConvexProblem& out) {
    std::vector<AffinePoint> points;
    for (int j = 0; j < problem_.intervals; ++j) {
      for (AffinePoint& p : curve_.minvo(j)) {
        if (p.fixed()) continue;
        add_box_rows(p);
        if (problem_.sphere_radius - (p.at(x0_) - problem_.start.p).norm() > problem_.reach) continue;
        points.push_back(std::move(p));
      }
    }
    out.sphere_weights.resize(static_cast<Eigen::Index>(points.size()), free_);
    out.sphere_offsets.resize(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
      out.sphere_weights.row(static_cast<Eigen::Index>(k)) = points[k].weights.transpose();
      out.sphere_offsets.col(static_cast<Eigen::Index>(k)) = points[k].offset - problem_.start.p;
    }
    out.sphere_radius2 = problem_.sphere_radius * problem_.sphere_radius;
  }

  void add_objective(ConvexProblem& out) const {
    const int n = 3 * free_;
    out.hessian = Eigen::MatrixXd::Zero(n, n);
    out.gradient = Eigen::VectorXd::Zero(n);
    for (int j = 0; j < problem_.intervals; ++j) add_square(out, curve_.jerk(j), Vec3::Zero(), problem_.weight_jerk);
    AffinePoint end{Eigen::VectorXd::Zero(free_), Vec3::Zero()};
    end.weights[free_ - 1] = 1.0;
    add_square(out, end, problem_.goal, problem_.weight_goal);
  }

  void take_rows(ConvexProblem& out) const {
    out.rows.resize(static_cast<Eigen::Index>(rows_.size()), 3 * free_);
    out.bounds.resize(out.rows.rows());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto r = static_cast<Eigen::Index>(i);
      out.rows.row(r) = rows_[i].transpose();
      out.bounds[r] = bounds_[i];
    }
    out.bounds = out.bounds.cwiseMax(out.rows * x0_ + Eigen::VectorXd::Constant(out.bounds.size(), kStartRoom)).eval();
    for (int k = 0; k < out.spheres(); ++k) {
      out.sphere_radius2 = std::max(out.sphere_radius2, out.sphere_point(k, x0_).squaredNorm() + kStartRoom);
    }
  }

 private:
  /// weight · ‖point − target‖².
  void add_square(ConvexProblem& out, const AffinePoint& point, const Vec3& target, double weight) const {
    const Vec3 offset = point.offset - target;
    for (int i = 0; i < free_; ++i) {
      for (int k = 0; k < free_; ++k) {
        const double h = 2.0 * weight * point.weights[i] * point.weights[k];
        for (int axis = 0; axis < 3; ++axis) out.hessian(3 * i + axis, 3 * k + axis) += h;
      }
      out.gradient.segment<3>(3 * i) += 2.0 * weight * point.weights[i] * offset;
    }
    out.constant += weight * offset.squaredNorm();
  }

  const TrajectoryProblem& problem_;
  const Eigen::VectorXd& x0_;
  CurvePoints curve_;
  int free_;
  std::vector<Eigen::VectorXd> rows_;
  std::vector<double> bounds_;
};

}  // namespace

Vec3 ConvexProblem::sphere_point(int k, const Eigen::VectorXd& x) const {
  Vec3 p = sphere_offsets.col(k);
  for (Eigen::Index i = 0; i < sphere_weights.cols(); ++i) p += sphere_weights(k, i) * x.segment<3>(3 * i);
  return p;
}

double ConvexProblem::worst_violation(const Eigen::VectorXd& x) const {
  double worst = rows.rows() > 0 ? (rows * x - bounds).maxCoeff() : 0.0;
  for (int k = 0; k < spheres(); ++k) worst = std::max(worst, sphere_point(k, x).squaredNorm() - sphere_radius2);
  return worst;
}

ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points) {
  ConvexProblem out;
  const Eigen::VectorXd x0 = free_variables(initial_control_points);
  Builder builder(problem, x0);
  builder.add_objective(out);
  builder.add_limits();
  builder.add_boxes_and_spheres(out);
  builder.add_planes(planes);
  builder.take_rows(out);
  return out;
}

}  // namespace tern
