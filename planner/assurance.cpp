#include "planner/assurance.h"

#include <algorithm>

#include "planner/problem/tuning.h"

namespace tern {

std::vector<Assurance> reduced_assurances(double side_step_s) {
  const auto times = [&](double share) { return std::min(kMaxSpan, Duration::from_seconds(share * side_step_s)); };
  std::vector<Assurance> made;
  for (const double share : kGrowthTimes) made.push_back({0, 1.0, times(share)});
  for (const int level : kReducedLevels) made.push_back({level, 1.0, times(1.0)});
  for (const double scale : kAlphaScales) made.push_back({kLevels - 1, scale, times(1.0)});
  return made;
}

double confidence_of(const Assurance& assurance, double set_confidence) {
  const bool is_known = assurance.scale == 1.0 && assurance.sure_for > Duration{0};
  return is_known ? confidence_at(set_confidence, assurance.level) : 0.0;
}

void apply_assurance(const Assurance& assurance, UTime t_s, std::vector<PlanningObstacle>& obstacles) {
  for (PlanningObstacle& obstacle : obstacles) {
    obstacle.alpha = {};
    if (obstacle.is_declared_or_static()) continue;
    const std::size_t last = obstacle.track->motion.locate(t_s + assurance.sure_for).index;
    obstacle.alpha = {assurance.level, assurance.scale, last};
  }
}

}  // namespace tern
