#include "planner/safety/checker.h"

#include <cmath>

#include "core/wire/message_limits.h"

namespace tern {
namespace {

BreachReport sphere_breach(const ClampedSpline& spline, const Vec3& centre, double radius) {
  for (int j = 0; j < spline.intervals(); ++j) {
    const double farthest = std::sqrt((spline.minvo(j).colwise() - centre).colwise().squaredNorm().maxCoeff());
    if (!(farthest <= radius * (1.0 + kLimitTolerance)))
      return {Breach::Sphere, "{0:.9g} m from the start, beyond {1:.9g}", farthest, radius, -1, j};
  }
  return {};
}

}  // namespace

CheckReport check_separation(const std::vector<PowerCubic>& pieces, SeparationCache& cache) {
  CheckReport report;
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const Separated result = separate_interval(cache, static_cast<int>(j), pieces[j], report.pairs, report.certificate);
    const bool fits = report.certificate.size() <= kMaxCertificatePlanes;
    if (result.ok && fits) continue;
    const auto planes = static_cast<double>(report.certificate.size());
    static_cast<BreachReport&>(report) =
        result.ok
            ? BreachReport{Breach::TooManyPlanes, "{0:.0f} planes, more than {1:.0f}", planes, kMaxCertificatePlanes}
            : BreachReport{Breach::NotSeparated, "an obstacle is not separated"};
    report.interval = static_cast<int>(j);
    report.obstacle = result.blocker;
    report.certificate.clear();
    break;
  }
  return report;
}

CheckReport check_plan(const TimedSpline& plan, const HorizonProblem& problem, SeparationCache& cache) {
  if (auto r = breach_of(plan, plan.start, problem.start, problem.limits, problem.centre_box); !r.ok()) return {r};
  const ClampedSpline spline = plan.spline();
  if (auto r = sphere_breach(spline, problem.start.p, problem.sphere_radius); !r.ok()) return {r};
  std::vector<PowerCubic> pieces;
  pieces.reserve(static_cast<std::size_t>(spline.intervals()));
  for (int j = 0; j < spline.intervals(); ++j) pieces.push_back(spline.power(j));
  return check_separation(pieces, cache);
}

}  // namespace tern
