#include "planner/semantics/semantic_guide.h"

#include <algorithm>
#include <cmath>

#include "planner/problem/tuning.h"

namespace tern {
double SemanticGuide::along(const Vec3& a, const Vec3& b) const {
  return cost_ == SemanticCost::Exposure ? fields_->exposure_cost(a, b) : 0.0;
}

double SemanticGuide::ahead(const Vec3& q) const {
  if (cost_ == SemanticCost::Exposure) return fields_->exposure_cost(q, start_ + way_);
  const double progress = std::clamp((q - start_).dot(way_) / std::max(way_.squaredNorm(), 1e-12), 0.0, 1.0);
  return fields_->mean_distance_cost(q) - fields_->mean_distance_cost(start_ + progress * way_);
}

double SemanticGuide::of(const ClampedSpline& trajectory, double from_s, double while_s) const {
  const int chords = std::max(1, static_cast<int>(std::ceil(while_s / kChord)));
  Vec3 at = trajectory.sample(from_s).p;
  double sum = 0.0;
  for (int k = 1; k <= chords; ++k) {
    const Vec3 next = trajectory.sample(from_s + while_s * k / chords).p;
    sum += along(at, next);
    at = next;
  }
  return sum + ahead(at);
}

}  // namespace tern
