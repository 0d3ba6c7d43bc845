#include "ros_messages/feed.h"

#include <algorithm>
#include <concepts>
#include <stdexcept>

#include "ros_messages/markers.h"

namespace tern::ros {
namespace {

/// Keeps the newest arrivals, whatever their names: after a jump back in a log, older names arrive again.
template <class Key, class Value>
void keep(std::deque<std::pair<Key, Value>>& kept, const Key& key, Value value, std::size_t most) {
  kept.emplace_back(key, std::move(value));
  if (kept.size() > most) kept.pop_front();
}

/// Returns the newest arrival of this name, or null.
template <class Key, class Value>
const Value* find(const std::deque<std::pair<Key, Value>>& kept, const Key& key) {
  const auto found = std::find_if(kept.rbegin(), kept.rend(), [&](const auto& entry) { return entry.first == key; });
  return found == kept.rend() ? nullptr : &found->second;
}

const FeedTopic& topic_named(std::string_view name, Drawings drawings) {
  const auto& all = feed_topics(drawings);
  const auto found = std::find_if(all.begin(), all.end(), [&](const FeedTopic& topic) { return topic.name == name; });
  if (found == all.end()) throw std::out_of_range("no topic " + std::string(name));
  return *found;
}

std::vector<FeedTopic> topics_with(const RosType& drawing) {
  using namespace topics;
  return {{kOdom, &ros_type<Odometry>()},
          {kTf, &ros_type<TFMessage>()},
          {kDetections, &ros_type<Detection3DArray>()},
          {kGoalPose, &ros_type<PoseStamped>(), true},
          {kPlan, &ros_type<Path>()},
          {kTrajectory, &ros_type<MultiDOFJointTrajectory>()},
          {kSetpoint, &ros_type<MultiDOFJointTrajectory>()},
          {kMap, &ros_type<PointCloud2>(), true},
          {kObstacles, &drawing},
          {kCommittedLine, &drawing},
          {kPlanLine, &drawing},
          {kHulls, &drawing},
          {kPlanes, &drawing},
          {kRegions, &drawing, true}};
}

}  // namespace

const std::vector<FeedTopic>& feed_topics(Drawings drawings) {
  static const std::vector<FeedTopic> kScenes = topics_with(ros_type<SceneUpdate>());
  static const std::vector<FeedTopic> kMarkers = topics_with(ros_type<MarkerArray>());
  return drawings == Drawings::Scenes ? kScenes : kMarkers;
}

template <Message T>
void Feed::write(std::string_view topic, const T& message) {
  const FeedTopic& named = topic_named(topic, drawings_);
  if constexpr (std::same_as<T, SceneUpdate>) {
    if (drawings_ == Drawings::Markers) return write_(named, encode_cdr(markers_of(message)));
  }
  write_(named, encode_cdr(message));
}

void Feed::receive(const UavState& state) {
  if (is_wanted(topics::kOdom)) write(topics::kOdom, odometry_of(state, position_sigma_, frames_));
  if (is_wanted(topics::kTf)) write(topics::kTf, transform_of(state, frames_));
}

void Feed::receive_setpoint(const UavState& setpoint) {
  if (is_wanted(topics::kSetpoint)) write(topics::kSetpoint, setpoint_of(setpoint, frames_));
}

void Feed::receive(const ObservationSet& frame) {
  if (is_wanted(topics::kDetections)) write(topics::kDetections, detections_of(frame, frames_));
}

void Feed::receive(const ObstacleTruth& complete_set) {
  if (!is_wanted(topics::kObstacles)) return;
  write(topics::kObstacles, SceneDrawing(frames_, complete_set.at).obstacles(complete_set));
}

void Feed::receive(const TrackSet& complete_set) {
  if (!is_wanted(topics::kHulls)) return;
  keep(tracks_, std::pair(complete_set.header.name.sender_epoch_us, complete_set.batch.set), complete_set, kKept);
}

void Feed::receive(const Goal& goal) {
  if (goal.mode == GoalMode::Go && is_wanted(topics::kGoalPose)) write(topics::kGoalPose, pose_of(goal, frames_));
}

void Feed::receive(const HorizonRequest& request) {
  keep(requests_, request.header.name, request.t_s, kKept);
  if (!is_wanted(topics::kCommittedLine)) return;
  write(topics::kCommittedLine,
        SceneDrawing(frames_, request.header.utime).line(request.committed, "committed", kCommittedColor));
}

void Feed::receive(const Plan& plan) {
  if (plan.outcome == PlanOutcome::NoPlan) return;
  if (is_wanted(topics::kPlan)) write(topics::kPlan, path_of(plan.trajectory, frames_));
  if (is_wanted(topics::kTrajectory)) write(topics::kTrajectory, trajectory_of(plan.trajectory, frames_));
  const SceneDrawing drawing(frames_, plan.header.utime);
  if (is_wanted(topics::kPlanLine)) write(topics::kPlanLine, drawing.line(plan.trajectory, "plan", kPlanColor));
  const UTime* t_s = find(requests_, plan.inputs.request);
  if (t_s != nullptr && is_wanted(topics::kPlanes)) write(topics::kPlanes, drawing.planes(plan, *t_s));
  const TrackSet* tracks =
      find(tracks_, std::pair(plan.inputs.predictions.sender_epoch_us, plan.inputs.prediction_set));
  const bool has_none = plan.inputs.predictions == MessageName{};
  if ((tracks != nullptr || has_none) && is_wanted(topics::kHulls)) {
    write(topics::kHulls, drawing.hulls(plan, has_none ? TrackSet() : *tracks));
  }
}

void Feed::receive(const VoxelMap& map, UTime at) {
  if (is_wanted(topics::kMap)) write(topics::kMap, cloud_of(map, at, frames_));
  if (is_wanted(topics::kRegions)) write(topics::kRegions, SceneDrawing(frames_, at).regions(map));
}

}  // namespace tern::ros
