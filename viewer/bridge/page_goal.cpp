#include "viewer/bridge/page_goal.h"

#include <algorithm>

namespace tern {
namespace {

constexpr Duration kGoalPeriod{1'000'000};

}  // namespace

void PageGoal::set(const Goal& goal, const Scene& scene, UTime now) {
  goal_ = goal;
  newest_id_ = goal.id;
  vehicle_us_ = scene.vehicle_us();
  next_ = now;
}

std::int64_t PageGoal::next_id(const Scene& scene) const {
  return std::max(newest_id_, scene.goal() ? scene.goal()->id : 0) + 1;
}

std::optional<Goal> PageGoal::due(const Scene& scene, UTime now) {
  if (!goal_ || now < next_) return std::nullopt;
  next_ = now + kGoalPeriod;
  if (vehicle_us_ == 0) vehicle_us_ = scene.vehicle_us();
  const bool overruled = scene.goal() && scene.goal()->id > goal_->id;
  if (overruled || scene.vehicle_us() != vehicle_us_) goal_.reset();
  return goal_;
}

}  // namespace tern
