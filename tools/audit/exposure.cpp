// Seconds and metres in and near each region, and whether the referee's verdict agrees with all this.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "tools/audit/audit.h"
#include "tools/audit/flown.h"

namespace tern::audit {
namespace {

constexpr double kNear = 1.0;    // m
constexpr double kStep = 0.001;  // s: what a crossing of a region's border may be off
/// Differences to the referee's measures that sampling explains.
constexpr double kSecondsOff = 0.05;
constexpr double kMetresOff = 0.3;
constexpr double kClearanceOff = 1e-3;
constexpr double kPathOff = 0.05;
constexpr double kSpeedOff = 0.01;

double to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * ab).norm();
}

/// Distance to a polygon's area: 0 where the sum of the angles to its corners winds around p.
double to_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& corners) {
  double winding = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d a = corners[k] - p;
    const Eigen::Vector2d b = corners[(k + 1) % corners.size()] - p;
    winding += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    nearest = std::min(nearest, to_segment(p, corners[k], corners[(k + 1) % corners.size()]));
  }
  return std::abs(winding) > 1.0 ? 0.0 : nearest;
}

}  // namespace

double distance_to(const Region& region, const Vec3& p) {
  if (const auto* box = std::get_if<Box>(&region.shape)) {
    return (box->min() - p).cwiseMax(p - box->max()).cwiseMax(0.0).norm();
  }
  if (const auto* ball = std::get_if<BallRegion>(&region.shape)) {
    return std::max(0.0, (p - ball->centre).norm() - ball->radius);
  }
  const auto& prism = std::get<PrismRegion>(region.shape);
  const double beside = to_polygon(p.head<2>(), prism.corners);
  const double above = std::max({prism.z_min - p.z(), p.z() - prism.z_max, 0.0});
  return std::hypot(beside, above);
}

namespace {

struct Measured {
  std::vector<Exposure> exposure;
  double path_m = 0.0, top_speed = 0.0;
};

Measured measure(const FlightRecord& record) {
  Measured measured;
  for (const Region& region : record.regions) measured.exposure.push_back({.region = region.name});
  const Window window = judged(record);
  for (const Sampled& span : flown(record).spans) {
    const double a = std::max(0.0, (window.from - span.curve.from).seconds());
    const double b = std::min(span.curve.length_s(), (window.to - span.curve.from).seconds());
    if (a >= b) continue;
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a) / kStep)));
    const double h = (b - a) / steps;
    for (int i = 0; i < steps; ++i) {
      const double s = a + (i + 0.5) * h;
      const double speed = span.curve.v(s).norm();
      measured.path_m += speed * h;
      measured.top_speed = std::max(measured.top_speed, speed);
      for (std::size_t k = 0; k < record.regions.size(); ++k) {
        const double distance = distance_to(record.regions[k], span.curve.p(s));
        Exposure& e = measured.exposure[k];
        if (distance <= 0.0) e.seconds += h, e.metres += speed * h;
        if (distance <= kNear) e.near_seconds += h, e.near_metres += speed * h;
      }
    }
  }
  return measured;
}

/// The referee's number against the auditor's.
void agree(const FlightRecord& record, Check& check, const std::string& what, double said, double found, double off) {
  ++check.checked;
  if (std::abs(said - found) <= off) return;
  check.fail({record.results.back().header.utime,
              fmt::format("FLIGHT_RESULT says {} {:.4g}, recomputed {:.4g}", what, said, found)});
}

}  // namespace

Check check_exposure(const FlightRecord& record) {
  Check check{.name = "exposure", .claim = "seconds and metres in and near each region are what the referee says"};
  if (record.regions.empty() && !record.results.empty() && !record.results.back().exposure.empty()) {
    check.unchecked["regions: no CONFIGURATION in the log tells their shapes"] = 1;
    return check;
  }
  if (record.regions.empty()) ++check.checked;
  if (record.regions.empty()) check.summary = "no regions";
  for (const Exposure& e : measure(record).exposure) {
    check.summary +=
        fmt::format("{}{}: {:.2f} s, {:.2f} m inside, {:.2f} s, {:.2f} m within 1 m", check.summary.empty() ? "" : "; ",
                    e.region, e.seconds, e.metres, e.near_seconds, e.near_metres);
    check.measures.insert(check.measures.end(), {{e.region + "_s", e.seconds},
                                                 {e.region + "_m", e.metres},
                                                 {e.region + "_near_s", e.near_seconds},
                                                 {e.region + "_near_m", e.near_metres}});
    if (record.results.empty()) {
      check.unchecked["regions without a FLIGHT_RESULT to compare with"] += 1;
      continue;
    }
    for (const Exposure& said : record.results.back().exposure) {
      if (said.region != e.region) continue;
      agree(record, check, e.region + ", seconds inside:", said.seconds, e.seconds, kSecondsOff);
      agree(record, check, e.region + ", metres inside:", said.metres, e.metres, kMetresOff);
      agree(record, check, e.region + ", seconds within 1 m:", said.near_seconds, e.near_seconds, kSecondsOff);
      agree(record, check, e.region + ", metres within 1 m:", said.near_metres, e.near_metres, kMetresOff);
    }
  }
  return check;
}

Check check_result(const FlightRecord& record, const Audit& audit) {
  Check check{.name = "result", .claim = "the referee's verdict agrees with what was recomputed"};
  if (record.results.empty()) {
    check.unchecked["the flight has no FLIGHT_RESULT"] = 1;
    return check;
  }
  const FlightResult& result = record.results.back();
  const Check& clearance = audit.check("clearance");
  const auto fail = [&](std::string what) { check.fail({result.header.utime, std::move(what)}); };
  ++check.checked;
  if (result.outcome == FlightOutcome::Reached && clearance.broken > 0)
    fail("says reached, but an obstacle was overlapped");
  if (clearance.measures.size() >= 2 && std::isfinite(result.min_clearance_m)) {
    ++check.checked;
    const double low = clearance.measures[0].second, high = clearance.measures[1].second, said = result.min_clearance_m;
    if (result.outcome == FlightOutcome::Collision) {
      if (low > 0.0) fail(fmt::format("says collision, but the least clearance is at least {:.4f} m", low));
    } else if (said < low - kClearanceOff || said > high + kClearanceOff) {
      fail(fmt::format("says least clearance {:.4f} m, recomputed {:.4f} to {:.4f} m", said, low, high));
    }
  }
  const Measured measured = measure(record);
  agree(record, check, "path length", result.path_length_m, measured.path_m, kPathOff);
  agree(record, check, "top speed", result.top_speed_mps, measured.top_speed, kSpeedOff);
  check.summary = fmt::format("{} after {:.2f} s and {:.2f} m{}{}", to_string(result.outcome), result.flight_time_s,
                              measured.path_m, result.detail.empty() ? "" : ": ", result.detail);
  check.measures = {{"path_m", measured.path_m}, {"top_speed_mps", measured.top_speed}};
  return check;
}

}  // namespace tern::audit
