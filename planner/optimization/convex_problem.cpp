#include "planner/optimization/convex_problem.h"

#include <algorithm>
#include <cmath>

#include "core/splines/minvo.h"

namespace tern {
namespace {

/// Limits farther away than this share of themselves are left out: an axis that x0 leaves at rest may go to half its
/// limit.
constexpr double kLimitReach = 1.5;

/// A point that is affine in the free control points: Σ_i weight_i q_{3+i} + offset. The same weights on each axis.
struct AffinePoint {
  Eigen::VectorXd weights;
  Vec3 offset = Vec3::Zero();
};

class Builder {
 public:
  Builder(const TrajectoryProblem& problem, const Eigen::VectorXd& x0)
      : problem_(problem),
        x0_(x0),
        basis_(spline_basis(problem.intervals)),
        free_(problem.intervals - 2),
        start_(start_control_points(problem.start, problem.interval_s)) {}

  /// Σ_k c_k q_{j+k}: a combination of the four control points of interval j.
  [[nodiscard]] AffinePoint combination(int j, const Eigen::Vector4d& c) const {
    AffinePoint p{Eigen::VectorXd::Zero(free_), Vec3::Zero()};
    for (int k = 0; k < 4; ++k) {
      const int l = j + k;
      if (l < 3)
        p.offset += c[k] * start_.col(l);
      else
        p.weights[std::min(l - 3, free_ - 1)] += c[k];  // q_{n-2} = q_{n-1} = q_n
    }
    return p;
  }

  /// direction·point ≤ limit; dropped when it does not depend on x, or when x0 is farther than `reach` from it.
  void add_row(const AffinePoint& point, const Vec3& direction, double limit, double reach) {
    if (point.weights.cwiseAbs().maxCoeff() < 1e-12) return;
    Eigen::VectorXd row(3 * free_);
    for (int i = 0; i < free_; ++i) row.segment<3>(3 * i) = point.weights[i] * direction;
    const double bound = limit - direction.dot(point.offset);
    const double at_x0 = row.dot(x0_);
    if (bound - at_x0 > reach) return;
    rows_.push_back(std::move(row));
    bounds_.push_back(std::max(bound, at_x0));
  }

  void add_symmetric(const AffinePoint& point, const Vec3& limits, double scale) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(limits[axis])) continue;
      AffinePoint scaled{point.weights * scale, point.offset * scale};
      add_row(scaled, Vec3::Unit(axis), limits[axis], kLimitReach * limits[axis]);
      add_row(scaled, -Vec3::Unit(axis), limits[axis], kLimitReach * limits[axis]);
    }
  }

  void add_planes(const std::vector<PlaneConstraint>& planes) {
    const double margin = std::max(problem_.clearance, kPlaneMarginOf) + kOptimizerMargin;
    for (const PlaneConstraint& c : planes) {
      const Eigen::Matrix4d weights = part_weights(c);
      for (int k = 0; k < 4; ++k) {
        add_row(combination(c.interval, weights.col(k)), c.plane.n, -c.plane.d - margin, problem_.reach);
      }
    }
  }

  void add_limits() {
    const double dt = problem_.interval_s;
    for (int j = 0; j < problem_.intervals; ++j) {
      if (j < 2) {
        add_symmetric(velocity_control_point(j + 2), problem_.limits.v_max, 1.0);
      } else {
        for (int k = 0; k < 3; ++k) {
          add_symmetric(combination(j, basis_.velocity_minvo(j).col(k)), problem_.limits.v_max, 1.0 / dt);
        }
      }
      if (j + 1 < problem_.intervals) {
        add_symmetric(combination(j, basis_.acceleration_ends(j).col(1)), problem_.limits.a_max, 1.0 / (dt * dt));
      }
      add_symmetric(combination(j, basis_.jerk(j)), problem_.limits.j_max, 1.0 / (dt * dt * dt));
    }
  }

  /// v_l = (q_{l+1} − q_l)/Δt for l ≥ 2: the first two intervals are bounded by these, because their MINVO points hang
  /// almost wholly on the start, which may move at the limit.
  [[nodiscard]] AffinePoint velocity_control_point(int l) const {
    AffinePoint p{Eigen::VectorXd::Zero(free_), Vec3::Zero()};
    const double scale = 1.0 / problem_.interval_s;
    p.weights[std::min(l - 2, free_ - 1)] += scale;
    if (l < 3)
      p.offset = -scale * start_.col(l);
    else
      p.weights[std::min(l - 3, free_ - 1)] -= scale;
    return p;
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
      for (int k = 0; k < 4; ++k) {
        AffinePoint p = combination(j, basis_.position_minvo(j).col(k));
        if (p.weights.cwiseAbs().maxCoeff() < 1e-12) continue;
        add_box_rows(p);
        if (problem_.sphere_radius - (at_x0(p) - problem_.start.p).norm() > problem_.reach) continue;
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

  [[nodiscard]] Vec3 at_x0(const AffinePoint& p) const {
    Vec3 at = p.offset;
    for (int i = 0; i < free_; ++i) at += p.weights[i] * x0_.segment<3>(3 * i);
    return at;
  }

  void add_objective(ConvexProblem& out) const {
    const int n = 3 * free_;
    out.hessian = Eigen::MatrixXd::Zero(n, n);
    out.gradient = Eigen::VectorXd::Zero(n);
    const double dt3 = problem_.interval_s * problem_.interval_s * problem_.interval_s;
    for (int j = 0; j < problem_.intervals; ++j) {
      add_square(out, combination(j, basis_.jerk(j) / dt3), Vec3::Zero(), problem_.weight_jerk);
    }
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
    // By the very product that judges feasibility: another order of summing would leave x0 outside by its rounding.
    out.bounds = out.bounds.cwiseMax(out.rows * x0_).eval();
    for (int k = 0; k < out.spheres(); ++k) {
      out.sphere_radius2 = std::max(out.sphere_radius2, out.sphere_point(k, x0_).squaredNorm());
    }
  }

 private:
  static constexpr double kPlaneMarginOf = 1e-9;

  [[nodiscard]] Eigen::Matrix4d part_weights(const PlaneConstraint& c) const {
    if (c.u0 == 0.0 && c.u1 == 1.0) return basis_.position_minvo(c.interval);
    // u = u0 + s(u1 − u0): powers of u from powers of s, highest first.
    const double w = c.u1 - c.u0;
    const double a = c.u0;
    Eigen::Matrix4d to_part;
    to_part << w * w * w, 3 * a * w * w, 3 * a * a * w, a * a * a,  //
        0, w * w, 2 * a * w, a * a,                                 //
        0, 0, w, a,                                                 //
        0, 0, 0, 1;
    return basis_.power(c.interval) * to_part * minvo_inverse_3();
  }

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
  const SplineBasis& basis_;
  int free_;
  Points3 start_;
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

Eigen::VectorXd free_variables(const Points& control_points) {
  const Eigen::Index n = control_points.cols() - 5;
  return Eigen::Map<const Eigen::VectorXd>(control_points.data() + 9, 3 * n);
}

Points control_points_of(const Eigen::VectorXd& x, const TrajectoryProblem& problem) {
  Points q(3, problem.intervals + 3);
  q.leftCols<3>() = start_control_points(problem.start, problem.interval_s);
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
