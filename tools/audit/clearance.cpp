// True clearance in continuous time, from states and truth alone.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tools/audit/audit.h"
#include "tools/audit/body_gap.h"
#include "tools/audit/flown.h"

namespace tern::audit {
namespace {

/// The least clearance is found to this, m.
constexpr double kResolution = 1e-4;
/// A collision's verdict comes at the first touch; what follows shows how deep it was.
constexpr Duration kAfterCollision{100'000};
constexpr double kFar = std::numeric_limits<double>::infinity();

struct Closest {
  double low = kFar, high = kFar;  ///< the least distance lies between them, errors of sampling included
  UTime at;
  std::int64_t obstacle = kNobody;  ///< nobody: none nearer than where the search began
};

/// One stretch of time of the vehicle against one obstacle.
struct Encounter {
  const Body& body;
  Vec3 half;
  Curve relative;      ///< vehicle − obstacle
  double error = 0.0;  ///< of the samples between which it lies, m
  std::int64_t obstacle = kNobody;
};

/// Lowers `best` where [a, b] holds less, by halving: the curve strays from its middle by no more than its Bernstein
/// points do, and the distance changes by no more than the curve.
void search(const Encounter& e, double a, double b, Closest& best) {
  const double middle = 0.5 * (a + b);
  const Vec3 p = e.relative.p(middle);
  const Gap gap = body_gap(e.body, p, e.half);
  const double low = gap.low - e.error;
  if (low < best.low) best = {low, gap.high + e.error, e.relative.from + Duration::from_seconds(middle), e.obstacle};
  if (low - (bernstein_points(e.relative, a, b).colwise() - p).colwise().norm().maxCoeff() >= best.low - kResolution)
    return;
  search(e, a, middle, best);
  search(e, middle, b, best);
}

Curve difference(const Curve& a, const Curve& b, UTime from, UTime to) {
  Curve relative = a.cut(from, to);
  const Curve other = b.cut(from, to);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 4; ++i) relative.axis[k].c[i] -= other.axis[k].c[i];
  }
  return relative;
}

/// All that a flight and one obstacle have in common in time.
template <class Visit>
void meet(const SampledMotion& vehicle, const SampledMotion& obstacle, const Window& window, const Visit& visit) {
  std::size_t k = 0;
  for (const Sampled& own : vehicle.spans) {
    while (k < obstacle.spans.size() && obstacle.spans[k].curve.to <= own.curve.from) ++k;
    for (std::size_t i = k; i < obstacle.spans.size() && obstacle.spans[i].curve.from < own.curve.to; ++i) {
      const Sampled& other = obstacle.spans[i];
      const UTime from = std::max({own.curve.from, other.curve.from, window.from});
      const UTime to = std::min({own.curve.to, other.curve.to, window.to});
      if (from < to) visit(difference(own.curve, other.curve, from, to), own.error_m + other.error_m);
    }
  }
}

struct Watch {
  const FlightRecord& record;
  Body body;
  Window window;
  SampledMotion vehicle;
  std::vector<ClearancePoint>& series;

  Closest watch(std::int64_t id, const ObstacleHistory& history, const Closest& nearest) {
    Closest best;
    // What stays farther than the nearest of all so far needs no exact minimum.
    best.low = std::max(nearest.low, 0.0);
    const Vec3 half = largest_half_extents(history);
    std::size_t point = 0;
    meet(vehicle, moved(history), window, [&](const Curve& relative, double error) {
      const Encounter e{body, half, relative, error, id};
      search(e, 0.0, relative.length_s(), best);
      while (point < series.size() && series[point].at < relative.from) ++point;
      for (; point < series.size() && series[point].at < relative.to; ++point) {
        const double gap = body_gap(body, relative.p((series[point].at - relative.from).seconds()), half).high;
        if (gap < series[point].clearance_m) series[point] = {series[point].at, gap, id};
      }
    });
    best.low -= kResolution;
    return best;
  }

  static Vec3 largest_half_extents(const ObstacleHistory& history) {
    Vec3 half = Vec3::Zero();
    for (const ObstacleHistory::Sample& s : history.samples) half = half.cwiseMax(s.half_extents);
    return half;
  }
};

void judge(const FlightRecord& record, const Closest& c, Check& check) {
  if (c.high < 0.0) {
    check.fail({c.at, fmt::format("overlaps obstacle {} by {:.3f} m", c.obstacle, -c.high), 0, c.obstacle});
  } else if (c.low < 0.0) {
    ++check
          .unchecked[fmt::format("whether obstacle {} was touched at {:.3f} s: sampled too coarsely to tell {:.4f} m "
                                 "from 0",
                                 c.obstacle, record.seconds(c.at), c.high)];
  }
}

void count_holes(const SampledMotion& motion, const std::string& what, Check& check) {
  if (motion.hole_count == 0) return;
  check.unchecked[fmt::format("{}: {:.2f} s in holes", what, motion.holes.seconds())] += motion.hole_count;
}

}  // namespace

Check check_clearance(const FlightRecord& record, std::vector<ClearancePoint>& series) {
  Check check{.name = "clearance", .claim = "the body stayed clear of every true obstacle, in continuous time"};
  if (record.requests.empty()) {
    check.unchecked["the body is not known: no HORIZON_REQUEST"] = 1;
    return check;
  }
  Watch watch{record, record.requests.front().body, judged(record), flown(record), series};
  const bool collided = !record.results.empty() && record.results.back().outcome == FlightOutcome::Collision;
  if (collided) watch.window.to = watch.window.to + kAfterCollision;
  count_holes(watch.vehicle, "UAV_STATE", check);
  for (const UavState& s : record.states) {
    if (s.at >= watch.window.from && s.at <= watch.window.to) series.push_back({s.at, kFar, kNobody});
  }
  Closest nearest;
  SampledMotion holes;
  for (const auto& [id, history] : record.truth) {
    const SampledMotion motion = moved(history);
    holes.holes = holes.holes + motion.holes;
    holes.hole_count += motion.hole_count;
    if (motion.spans.empty()) continue;
    const Closest closest = watch.watch(id, history, nearest);
    ++check.checked;
    if (closest.obstacle == kNobody) continue;
    judge(record, closest, check);
    if (closest.low < nearest.low) nearest = closest;
  }
  count_holes(holes, "OBSTACLE_TRUTH", check);
  if (record.truth_left_out > 0) check.unchecked["obstacles that OBSTACLE_TRUTH left out"] = record.truth_left_out;
  std::erase_if(series, [](const ClearancePoint& p) { return p.obstacle == kNobody; });
  if (nearest.obstacle == kNobody) return check;
  check.summary = fmt::format("least {:.4f} to {:.4f} m, to obstacle {} at {:.3f} s; {} obstacles", nearest.low,
                              nearest.high, nearest.obstacle, record.seconds(nearest.at), check.checked);
  check.measures = {{"least_m_at_least", nearest.low},
                    {"least_m_at_most", nearest.high},
                    {"least_obstacle", static_cast<double>(nearest.obstacle)},
                    {"least_at_s", record.seconds(nearest.at)},
                    {"obstacles", static_cast<double>(check.checked)}};
  return check;
}

}  // namespace tern::audit
