#include "planner/optimization/convex_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/problem/tuning.h"
#include "planner/safety/thrust_set.h"

namespace tern {
namespace {

/// A reach for rows that are always constraints, however far x0 is.
constexpr double kAlways = std::numeric_limits<double>::infinity();

class Builder {
 public:
  Builder(const TrajectoryProblem& problem, const FreeVariables& x0, ConvexProblem& out)
      : problem_(problem), x0_(x0), curve_(problem), free_(problem.intervals - 2), out_(out) {
    out.rows.clear();
    out.bounds.clear();
    out.sphere_weights.clear();
    out.sphere_offsets.clear();
  }

  /// Adds direction·point ≤ limit, unless it does not depend on x, or x0 is farther than `reach` from it.
  void add_row(const AffinePoint& point, const Vec3& direction, double limit, double reach) {
    if (point.fixed()) return;
    FreeVariables row(3 * free_);
    for (Eigen::Index i = 0; i < free_; ++i) row.segment<3>(3 * i) = point.weights[i] * direction;
    const double bound = limit - direction.dot(point.offset);
    const double at_x0 = row.dot(x0_);
    if (bound - at_x0 > reach) return;
    out_.add_row(row, std::max(bound, at_x0));
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

  /// Bounds velocities by hull points, in the first two intervals by velocity control points: hull points there depend
  /// almost wholly on the start, which may move at the limit.
  void add_limits() {
    for (int j = 0; j < problem_.intervals; ++j) {
      if (j < 2) {
        add_symmetric(curve_.velocity_control_point(j + 2), problem_.plan_limits.v_max);
      } else {
        for (const AffinePoint& p : curve_.velocity_hull(j)) add_symmetric(p, problem_.plan_limits.v_max);
      }
      if (j + 1 < problem_.intervals) add_symmetric(curve_.acceleration_at_end(j), problem_.plan_limits.a_max);
      add_symmetric(curve_.jerk(j), problem_.plan_limits.j_max);
    }
  }

  /// Adds thrust and tilt (ThrustSet) at the free knots, and body rates per interval. Body rates are bounded by |j| ≤
  /// rate · least f_z of the interval, where f_z keeps kMinThrustKept of that of x0. If the jerk of x0 is larger, it is
  /// the bound.
  void add_dynamics() {
    if (!problem_.plan_limits.dynamics) return;
    const ThrustSet set(*problem_.plan_limits.dynamics);
    double before = std::max(set.floor, problem_.start.a.z() + kGravity);
    for (int j = 0; j < problem_.intervals; ++j) {
      double after = kGravity;
      if (j + 1 < problem_.intervals) {
        AffinePoint thrust = curve_.acceleration_at_end(j);
        thrust.offset.z() += kGravity;
        after = std::max(set.floor, kMinThrustKept * thrust.at(x0_).z());
        add_row(thrust, -Vec3::UnitZ(), -after, kAlways);
        add_tilt(thrust, set.slope);
        add_ball(thrust, set.thrust_max);
      }
      const AffinePoint jerk = curve_.jerk(j);
      add_ball(jerk, std::max(set.rate * std::min(before, after), kJerkRoom * jerk.at(x0_).norm()));
      before = after;
    }
  }

  /// Adds only the sides that cut the sphere: the others follow from it, and each row costs Ipopt time.
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

  void add_boxes_and_spheres() {
    for (int j = 0; j < problem_.intervals; ++j) {
      for (const AffinePoint& p : curve_.minvo(j)) {
        if (p.fixed()) continue;
        add_box_rows(p);
        if (problem_.sphere_radius - (p.at(x0_) - problem_.start.p).norm() > problem_.reach) continue;
        add_sphere(p.weights, p.offset - problem_.start.p);
      }
    }
    out_.sphere_radius2 = problem_.sphere_radius * problem_.sphere_radius;
  }

  void add_objective() {
    const int n = 3 * free_;
    out_.hessian.setZero(n, n);
    out_.gradient.setZero(n);
    out_.constant = 0.0;
    for (int j = 0; j < problem_.intervals; ++j) add_square(curve_.jerk(j), Vec3::Zero(), problem_.weight_jerk);
    AffinePoint end{FreeWeights::Zero(free_), Vec3::Zero()};
    end.weights[free_ - 1] = 1.0;
    add_square(end, problem_.goal, problem_.weight_goal);
  }

  /// Widens bounds so that x0 is strictly feasible.
  void widen_bounds() {
    for (int r = 0; r < out_.row_count(); ++r) {
      double& bound = out_.bounds[idx(r)];
      bound = std::max(bound, out_.row_times(r, x0_) + kStartRoom);
    }
    for (int k = 0; k < out_.spheres(); ++k) {
      out_.sphere_radius2 = std::max(out_.sphere_radius2, out_.sphere_point(k, x0_).squaredNorm() + kStartRoom);
    }
  }

 private:
  void add_sphere(const FreeWeights& weights, const Vec3& offset) {
    out_.sphere_weights.insert(out_.sphere_weights.end(), weights.data(), weights.data() + weights.size());
    out_.sphere_offsets.push_back(offset);
  }

  /// Adds ‖point‖ ≤ radius, scaled to the radius of S.
  void add_ball(const AffinePoint& point, double radius) {
    if (point.fixed()) return;
    const double scale = problem_.sphere_radius / radius;
    add_sphere(point.weights * scale, point.offset * scale);
  }

  /// Adds ‖f_xy‖₈ ≤ slope f_z.
  void add_tilt(const AffinePoint& thrust, double slope) {
    for (const Vec3& side : {Vec3(1.0, kOctagon, -slope), Vec3(kOctagon, 1.0, -slope)}) {
      for (int signs = 0; signs < 4; ++signs) {
        const Vec3 direction((signs & 1) != 0 ? -side.x() : side.x(), (signs & 2) != 0 ? -side.y() : side.y(),
                             side.z());
        add_row(thrust, direction, 0.0, kAlways);
      }
    }
  }

  /// Adds weight · ‖point − target‖² to the objective.
  void add_square(const AffinePoint& point, const Vec3& target, double weight) {
    const Vec3 offset = point.offset - target;
    for (Eigen::Index i = 0; i < free_; ++i) {
      for (Eigen::Index k = 0; k < free_; ++k) {
        const double h = 2.0 * weight * point.weights[i] * point.weights[k];
        for (int axis = 0; axis < 3; ++axis) out_.hessian(3 * i + axis, 3 * k + axis) += h;
      }
      out_.gradient.segment<3>(3 * i) += 2.0 * weight * point.weights[i] * offset;
    }
    out_.constant += weight * offset.squaredNorm();
  }

  const TrajectoryProblem& problem_;
  const FreeVariables& x0_;
  CurvePoints curve_;
  int free_;
  ConvexProblem& out_;
};

}  // namespace

double ConvexProblem::row_times(int r, const FreeVariables& x) const {
  const double* a = row(r);
  double sum = 0.0;
  for (Eigen::Index c = 0; c < x.size(); ++c) sum += a[c] * x[c];
  return sum;
}

Vec3 ConvexProblem::sphere_point(int k, const FreeVariables& x) const {
  Vec3 p = sphere_offsets[idx(k)];
  for (int c = 0; c < variables(); c += 3) p += sphere_weight(k, c) * x.segment<3>(c);
  return p;
}

double ConvexProblem::objective(const FreeVariables& x) const {
  FreeVariables curved(x.size());
  curved.noalias() = hessian * x;
  return 0.5 * x.dot(curved) + gradient.dot(x) + constant;
}

double ConvexProblem::worst_violation(const FreeVariables& x) const {
  double worst = -std::numeric_limits<double>::infinity();
  const auto take = [&worst](double violation) {
    if (!std::isnan(worst) && !(violation <= worst)) worst = violation;
  };
  for (int r = 0; r < row_count(); ++r) take(row_times(r, x) - bounds[idx(r)]);
  for (int k = 0; k < spheres(); ++k) take(sphere_point(k, x).squaredNorm() - sphere_radius2);
  return worst;
}

void ConvexProblem::add_row(const FreeVariables& row, double bound) {
  rows.insert(rows.end(), row.data(), row.data() + row.size());
  bounds.push_back(bound);
}

void make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                         const Points& initial_control_points, ConvexProblem& out) {
  const FreeVariables x0 = free_variables(initial_control_points);
  Builder builder(problem, x0, out);
  builder.add_objective();
  builder.add_limits();
  builder.add_dynamics();
  builder.add_boxes_and_spheres();
  builder.add_planes(planes);
  builder.widen_bounds();
}

ConvexProblem make_convex_problem(const TrajectoryProblem& problem, const std::vector<PlaneConstraint>& planes,
                                  const Points& initial_control_points) {
  ConvexProblem out;
  make_convex_problem(problem, planes, initial_control_points, out);
  return out;
}

}  // namespace tern
