#include "planner/assurance.h"

#include <algorithm>

#include "planner/tuning.h"

namespace tern {

namespace {

Duration span_of(double seconds) { return std::min(kMaxSpan, Duration::from_seconds(seconds)); }

}  // namespace

std::vector<Assurance> lower_assurances(double aside_s) {
  const auto times = [&](double share) { return span_of(share * aside_s); };
  constexpr int kLast = kLevels - 1;
  std::vector<Assurance> made;
  for (const double share : kSureTimes) made.push_back({0, 1.0, times(share)});
  for (const int level : kLowerLevels) made.push_back({level, 1.0, times(1.0)});
  for (const double share : kShortTimes) made.push_back({kLast, 1.0, times(share)});
  for (const double scale : kAlphaScales) made.push_back({kLast, scale, Duration{0}});
  return made;
}

bool is_too_short(const Assurance& assurance, double aside_s) {
  return assurance.sure_for < span_of(aside_s) || assurance.scale < 1.0;
}

void count_alpha(const Assurance& assurance, UTime t_s, std::vector<PlanningObstacle>& obstacles) {
  for (PlanningObstacle& obstacle : obstacles) {
    obstacle.alpha = {};
    if (obstacle.is_promised()) continue;
    const std::size_t last = obstacle.track->motion.locate(t_s + assurance.sure_for).index;
    obstacle.alpha = {assurance.level, assurance.scale, last};
  }
}

}  // namespace tern
