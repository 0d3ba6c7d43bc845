#include "planner/assurance.h"

#include "planner/tuning.h"

namespace tern {

const std::vector<Assurance>& lower_assurances() {
  static const std::vector<Assurance> all = [] {
    std::vector<Assurance> made;
    for (int level = 1; level < kLevels; ++level) made.push_back({level, 1.0});
    for (const double scale : kAlphaScales) made.push_back({kLevels - 1, scale});
    return made;
  }();
  return all;
}

void count_alpha(const Assurance& assurance, std::vector<PlanningObstacle>& obstacles) {
  for (PlanningObstacle& obstacle : obstacles) {
    obstacle.alpha = obstacle.is_promised() ? AlphaCount{} : AlphaCount{assurance.level, assurance.scale};
  }
}

}  // namespace tern
