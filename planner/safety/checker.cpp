#include "planner/safety/checker.h"

#include <cmath>

#include "core/splines/minvo.h"
#include "core/world/message_limits.h"

namespace tern {
namespace {

CheckReport fault(CheckFault kind, int interval, int axis, double value, double limit) {
  CheckReport report;
  report.fault = kind;
  report.interval = interval;
  report.axis = axis;
  report.value = value;
  report.limit = limit;
  return report;
}

bool has_shape(const TimedSpline& plan) {
  const Eigen::Index n = plan.control_points.cols();
  return n >= 7 && n <= kMaxIntervals + 3 && plan.interval.us > 0 && plan.control_points.allFinite();
}

CheckReport check_start(const ClampedSpline& spline, const MotionSample& start) {
  const MotionSample s = spline.sample(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double error : {s.p[axis] - start.p[axis], s.v[axis] - start.v[axis], s.a[axis] - start.a[axis]}) {
      if (!(std::abs(error) <= kJoinTolerance)) return fault(CheckFault::Start, 0, axis, error, kJoinTolerance);
    }
  }
  return {};
}

CheckReport check_limit(CheckFault kind, int interval, const Vec3& value, const Vec3& limit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(value[axis] <= limit[axis] * (1.0 + kLimitTolerance))) {
      return fault(kind, interval, axis, value[axis], limit[axis]);
    }
  }
  return {};
}

CheckReport check_limits(const ClampedSpline& spline, const Limits& limits) {
  for (int j = 0; j < spline.intervals(); ++j) {
    const MotionBounds bounds = motion_bounds(spline, j);
    if (auto r = check_limit(CheckFault::Velocity, j, bounds.v_max, limits.v_max); !r.ok()) return r;
    if (auto r = check_limit(CheckFault::Acceleration, j, bounds.a_max, limits.a_max); !r.ok()) return r;
    if (auto r = check_limit(CheckFault::Jerk, j, bounds.j_max, limits.j_max); !r.ok()) return r;
  }
  return {};
}

CheckReport check_sphere(const ClampedSpline& spline, const Vec3& centre, double radius) {
  for (int j = 0; j < spline.intervals(); ++j) {
    const double farthest = std::sqrt((spline.minvo(j).colwise() - centre).colwise().squaredNorm().maxCoeff());
    if (!(farthest <= radius * (1.0 + kLimitTolerance))) return fault(CheckFault::Sphere, j, -1, farthest, radius);
  }
  return {};
}

CheckReport check_centre_box(const ClampedSpline& spline, const Box& centre_box) {
  const Box allowed = grown(centre_box, Vec3::Constant(kBoxTolerance));
  for (int j = 0; j < spline.intervals(); ++j) {
    const Box held = spline.position_bounds(j);
    for (int axis = 0; axis < 3; ++axis) {
      if (held.min()[axis] < allowed.min()[axis]) {
        return fault(CheckFault::FlightBox, j, axis, held.min()[axis], centre_box.min()[axis]);
      }
      if (held.max()[axis] > allowed.max()[axis]) {
        return fault(CheckFault::FlightBox, j, axis, held.max()[axis], centre_box.max()[axis]);
      }
    }
  }
  return {};
}

}  // namespace

const char* to_string(CheckFault fault) {
  constexpr const char* kNames[] = {"none",        "shape",  "start",      "velocity",      "acceleration",   "jerk",
                                    "not at rest", "sphere", "flight box", "not separated", "too many planes"};
  return kNames[static_cast<int>(fault)];
}

CheckReport check_separation(const std::vector<PowerCubic>& pieces, SweptObstacles& obstacles) {
  CheckReport report;
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const Separated result =
        separate_interval(obstacles, static_cast<int>(j), pieces[j], report.pairs, report.certificate);
    const bool fits = report.certificate.size() <= kMaxCertificatePlanes;
    if (result.ok && fits) continue;
    report.fault = result.ok ? CheckFault::TooManyPlanes : CheckFault::NotSeparated;
    report.interval = static_cast<int>(j);
    report.obstacle = result.blocker;
    report.value = static_cast<double>(report.certificate.size());
    report.limit = kMaxCertificatePlanes;
    report.certificate.clear();
    break;
  }
  return report;
}

CheckReport check_plan(const TimedSpline& plan, const HorizonProblem& problem, SweptObstacles& obstacles) {
  if (!has_shape(plan)) return fault(CheckFault::Shape, -1, -1, static_cast<double>(plan.control_points.cols()), 7.0);
  const ClampedSpline spline = plan.spline();
  if (auto r = check_start(spline, problem.start); !r.ok()) return r;
  if (auto r = check_limits(spline, problem.limits); !r.ok()) return r;
  if (!spline.ends_at_rest()) return fault(CheckFault::NotAtRest, spline.intervals() - 1, -1, 0.0, 0.0);
  if (auto r = check_sphere(spline, problem.start.p, problem.sphere_radius); !r.ok()) return r;
  if (auto r = check_centre_box(spline, problem.centre_box); !r.ok()) return r;
  std::vector<PowerCubic> pieces;
  pieces.reserve(static_cast<std::size_t>(spline.intervals()));
  for (int j = 0; j < spline.intervals(); ++j) pieces.push_back(spline.power(j));
  return check_separation(pieces, obstacles);
}

}  // namespace tern
