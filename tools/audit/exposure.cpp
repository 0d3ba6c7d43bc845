// Seconds and metres in and near each region.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/audit/audit.h"
#include "tools/audit/measures.h"

namespace tern::audit {
namespace {

/// Longest step of the referee at a region's border, s; it may miss a shorter visit.
constexpr double kRefereeStep = 0.01;

double to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * ab).norm();
}

/// Returns the signed distance to a polygon's area: negative if the angles to its corners wind around p.
double to_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& corners) {
  double winding = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d a = corners[k] - p;
    const Eigen::Vector2d b = corners[(k + 1) % corners.size()] - p;
    winding += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    nearest = std::min(nearest, to_segment(p, corners[k], corners[(k + 1) % corners.size()]));
  }
  return std::abs(winding) > 1.0 ? -nearest : nearest;
}

/// Returns "12.30", or "12.10 to 12.50" if the bounds are wider.
std::string text(const Between& x) {
  constexpr double kShown = 0.02;
  if (x.high - x.low < kShown) return fmt::format("{:.2f}", x.best);
  return fmt::format("{:.2f} to {:.2f}", x.low, x.high);
}

/// Compares the referee's values of one region with the auditor's bounds.
void compare(const FlightRecord& record, const Measures& measures, const RegionMeasure& r, const Exposure& reported,
             Check& check) {
  const auto agree = [&](const char* what, double value, const Between& found, double off) {
    ++check.checked;
    if (value >= found.low - off && value <= found.high + off) return;
    check.fail({record.results.back().header.utime,
                fmt::format("FLIGHT_RESULT says {}, {} {:.4g}, recomputed {}", r.region, what, value, text(found))});
  };
  const double off_s = kRefereeStep * (1 + r.border.crossings);
  const double near_off_s = kRefereeStep * (1 + r.near_border.crossings);
  const double speed = measures.top_speed.high;
  agree("seconds inside:", reported.seconds, r.seconds, off_s);
  agree("metres inside:", reported.metres, r.metres, off_s * speed);
  agree("seconds within 1 m:", reported.near_seconds, r.near_seconds, near_off_s);
  agree("metres within 1 m:", reported.near_metres, r.near_metres, near_off_s * speed);
}

}  // namespace

double distance_to(const Region& region, const Vec3& p) {
  if (const auto* box = std::get_if<Box>(&region.shape)) {
    const Vec3 beyond = (box->min() - p).cwiseMax(p - box->max());
    return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : beyond.maxCoeff();
  }
  if (const auto* ball = std::get_if<BallRegion>(&region.shape)) return (p - ball->centre).norm() - ball->radius;
  const auto& prism = std::get<PrismRegion>(region.shape);
  const double beside = to_polygon(p.head<2>(), prism.corners);
  const double above = std::max(prism.z_min - p.z(), p.z() - prism.z_max);
  const bool inside = beside <= 0.0 && above <= 0.0;
  return inside ? std::max(beside, above) : std::hypot(std::max(beside, 0.0), std::max(above, 0.0));
}

Check check_exposure(const FlightRecord& record) {
  Check check{.name = "exposure", .claim = "seconds and metres in and near each region are what the referee says"};
  if (record.regions.empty() && !record.results.empty() && !record.results.back().exposure.empty()) {
    check.unchecked["regions: the log has no CONFIGURATION with their shapes"] = 1;
    return check;
  }
  if (record.regions.empty()) {
    ++check.checked;
    check.summary = "no regions";
    return check;
  }
  const Measures measures = measure(record);
  for (const RegionMeasure& r : measures.regions) {
    check.summary += fmt::format("{}{}: {} s, {} m inside, {} s, {} m within 1 m", check.summary.empty() ? "" : "; ",
                                 r.region, text(r.seconds), text(r.metres), text(r.near_seconds), text(r.near_metres));
    check.measures.insert(check.measures.end(), {{r.region + "_s", r.seconds.best},
                                                 {r.region + "_m", r.metres.best},
                                                 {r.region + "_near_s", r.near_seconds.best},
                                                 {r.region + "_near_m", r.near_metres.best}});
    if (record.results.empty()) {
      check.unchecked["regions without a FLIGHT_RESULT to compare with"] += 1;
      continue;
    }
    for (const Exposure& reported : record.results.back().exposure) {
      if (reported.region == r.region) compare(record, measures, r, reported, check);
    }
  }
  return check;
}

}  // namespace tern::audit
