#include "ros_bridge/goal_sender.h"

#include <algorithm>

namespace tern::ros {

void GoalSender::ask(const Vec3& position) {
  const bool is_same = heard_ && heard_->mode == GoalMode::Go && heard_->position == position;
  asked_ = is_same ? std::nullopt : std::optional(position);
}

void GoalSender::hear(const Goal& goal, bool own) {
  if (!heard_ || goal.id >= heard_->id) heard_ = goal;
  if (!own && goal_ && goal.id >= goal_->id) goal_.reset();
}

std::optional<Goal> GoalSender::due(UTime now) {
  if (asked_ && now - sent_ >= kSpacing) {
    goal_.emplace();
    goal_->id = std::max(now.us, heard_ ? heard_->id + 1 : 1);
    goal_->position = *asked_;
    asked_.reset();
    heard_ = goal_;
  } else if (!goal_ || now - sent_ < kRepeat) {
    return std::nullopt;
  }
  sent_ = now;
  return goal_;
}

}  // namespace tern::ros
