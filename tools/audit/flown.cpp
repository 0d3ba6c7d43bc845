#include "tools/audit/flown.h"

#include <algorithm>
#include <cmath>

namespace tern::audit {
namespace {

struct Knot {
  UTime at;
  Vec3 p, v;
};

SampledMotion connect(const std::vector<Knot>& knots, Duration hole) {
  SampledMotion motion;
  const auto change = [&](std::size_t k) { return (knots[k + 1].v - knots[k].v).norm(); };
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const Knot& a = knots[k];
    const Knot& b = knots[k + 1];
    if (b.at - a.at > hole) {
      motion.holes = motion.holes + (b.at - a.at);
      ++motion.hole_count;
      continue;
    }
    double largest = change(k);
    if (k > 0) largest = std::max(largest, change(k - 1));
    if (k + 2 < knots.size()) largest = std::max(largest, change(k + 1));
    motion.spans.push_back({hermite(a.at, a.p, a.v, b.at, b.p, b.v), largest * (b.at - a.at).seconds() / 8.0});
  }
  return motion;
}

}  // namespace

SampledMotion flown(const FlightRecord& record) {
  std::vector<Knot> knots;
  for (const UavState& s : record.states) knots.push_back({s.at, s.motion.p, s.motion.v});
  return connect(knots, kStateHole);
}

SampledMotion moved(const ObstacleHistory& history) {
  std::vector<Knot> knots;
  for (const ObstacleHistory::Sample& s : history.samples) knots.push_back({s.at, s.p, s.v});
  return connect(knots, history.moves ? kTruthHole : Duration{INT64_MAX / 2});
}

Window judged(const FlightRecord& record) {
  Window window{record.zero(), record.end()};
  if (record.results.empty() || record.requests.empty()) return window;
  const double flight_time_s = record.results.back().flight_time_s;
  if (std::isnan(flight_time_s)) return window;
  window.to = std::min(window.to, window.from + Duration::from_seconds(flight_time_s));
  return window;
}

}  // namespace tern::audit
