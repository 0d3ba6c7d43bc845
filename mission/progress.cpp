#include "mission/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "core/scenario/scenario.h"

namespace tern::mission {
namespace {

constexpr Duration kGoalPeriod{1'000'000};
constexpr int kStepBits = 12;
constexpr std::int64_t kStepMask = (std::int64_t{1} << kStepBits) - 1;
static_assert(kMaxSteps < kNoStep && kNoStep == kStepMask);

}  // namespace

std::optional<int> step_of(std::int64_t goal_id) {
  const auto step = static_cast<int>(goal_id & kStepMask);
  return step < kMaxSteps ? std::optional(step) : std::nullopt;
}

std::int64_t goal_id(int step, UTime now, std::int64_t largest) {
  const std::int64_t time = std::max(now.us - kStepMask - 1, std::int64_t{0}) >> kStepBits;
  const std::int64_t after = largest >> kStepBits;
  const std::int64_t block = (after << kStepBits | step) > largest ? after : after + 1;
  return std::max(time, block) << kStepBits | step;
}

double time_limit_s(const Vec3& from, const Vec3& to, const Limits& limits) {
  return 3.0 * rest_to_rest_bound_s(from, to, limits) + 30.0;
}

Vec3 velocity_limits(double speed, const Vec3& from, const Vec3& to, const Limits& limits) {
  const Eigen::Vector2d way = (to - from).head<2>();
  const Eigen::Vector2d along =
      way.norm() > 0.0 ? Eigen::Vector2d(way.normalized().cwiseAbs()) : Eigen::Vector2d::Zero();
  const Eigen::Vector2d level = speed * along.cwiseMax(std::numbers::sqrt2 / 2.0);
  return limits.v_max.cwiseMin(Vec3(level.x(), level.y(), limits.v_max.z()));
}

Progress::Progress(Mission mission, const ProgressConfig& config, const Limits& limits)
    : mission_(std::move(mission)), config_(config), limits_(limits), reached_(mission_.steps.size()) {}

std::optional<int> Progress::step_of_own(const Goal& goal) const {
  const auto step = step_of(goal.id);
  if (goal.mode != GoalMode::Go || !step || *step >= static_cast<int>(mission_.steps.size())) return std::nullopt;
  const Step& at = mission_.steps[idx(*step)];
  return at.action == Action::Follow || at.position == goal.position ? step : std::nullopt;
}

void Progress::start(const std::optional<Goal>& heard, const std::optional<Remembered>& remembered, UTime now) {
  has_started_ = true;
  const bool is_known = heard && remembered && remembered->reached.size() == reached_.size();
  const auto step = heard ? step_of_own(*heard) : std::nullopt;
  if (heard) largest_id_ = std::max(largest_id_, heard->id);
  if (is_known) reached_ = remembered->reached;
  if (is_known && remembered->ended) {
    step_ = remembered->step;
    stand_ = *remembered->ended;
    why_failed_ = remembered->text;
    return;
  }
  if (step) {
    step_ = *step;
  } else if (is_known) {
    step_ = remembered->step;
    const bool is_own = heard->mode == GoalMode::Hold && (heard->id & kStepMask) == kNoStep;
    if (!is_own) other_ = heard;
    if (!is_own || remembered->is_paused) {
      stand_ = Stand::Paused;
      if (is_own) send(GoalMode::Hold, Vec3::Zero(), now);
      return;
    }
  }
  if (following_) return fly_to(step_, now);
  send(GoalMode::Hold, Vec3::Zero(), now);
}

void Progress::send(GoalMode mode, const Vec3& position, UTime now) {
  goal_.emplace();
  goal_->id = goal_id(mode == GoalMode::Go ? step_ : kNoStep, now, largest_id_);
  goal_->mode = mode;
  goal_->position = position;
  largest_id_ = goal_->id;
  next_goal_ = now;
  const Step& step = mission_.steps[idx(step_)];
  speed_limit_.reset();
  if (mode != GoalMode::Go || step.speed == 0.0) return;
  speed_limit_.emplace();
  speed_limit_->goal_id = goal_->id;
  speed_limit_->v_max = step.action == Action::Follow
                            ? limits_.v_max.cwiseMin(Vec3(step.speed, step.speed, limits_.v_max.z()))
                            : velocity_limits(step.speed, position_, position, limits_);
}

void Progress::fly_to(int step, UTime now) {
  step_ = step;
  stand_ = Stand::Flying;
  step_since_ = track_at_ = now;
  sent_from_ = position_;
  other_.reset();
  track_.reset();
  const Step& at = mission_.steps[idx(step)];
  if (at.action == Action::Follow) return send(GoalMode::Hold, Vec3::Zero(), now);  // until the track is received
  send(GoalMode::Go, at.position, now);
}

void Progress::advance(UTime now) {
  passes_late_ = false;
  if (step_ + 1 < static_cast<int>(mission_.steps.size())) return fly_to(step_ + 1, now);
  stand_ = Stand::Done;
}

void Progress::fail(std::string why, UTime now) {
  stand_ = Stand::Failed;
  why_failed_ = std::move(why);
  send(GoalMode::Hold, Vec3::Zero(), now);
}

void Progress::set_following(bool following, UTime now) {
  if (following == std::exchange(following_, following) || !following || !has_started_) return;
  step_since_ = track_at_ = now;
  sent_from_ = position_;  // a pilot may have moved the vehicle
  if (stand_ == Stand::Waiting) fly_to(step_, now);
}

void Progress::receive(const Goal& goal, UTime now) {
  if (goal.id <= largest_id_ || !has_started_) return;
  largest_id_ = goal.id;
  if (stand_ == Stand::Done || stand_ == Stand::Failed) {
    goal_.reset();  // somebody else flies the vehicle
    return;
  }
  other_ = goal;
  goal_.reset();
  passing_.reset();
  stand_ = Stand::Paused;
  step_since_ = now;
}

bool Progress::pause(UTime now) {
  if (stand_ != Stand::Flying && stand_ != Stand::Staying && stand_ != Stand::Paused) return false;
  other_.reset();
  passing_.reset();
  stand_ = Stand::Paused;
  send(GoalMode::Hold, Vec3::Zero(), now);
  return true;
}

bool Progress::go_on(UTime now) {
  if (stand_ != Stand::Paused || !following_) return false;
  fly_to(step_, now);
  return true;
}

double Progress::radius_of(const Step& step) const { return step.radius > 0.0 ? step.radius : config_.radius_m; }

bool Progress::rests_at(const UavState& state, const Vec3& place) const {
  return (state.motion.p - place).norm() <= config_.stop_radius_m && state.motion.v.norm() <= kSpeedAtRest;
}

void Progress::receive(const UavState& state, UTime now) {
  position_ = state.motion.p;
  if (!following_ || !has_started_) return;
  if (stand_ == Stand::Paused) {
    if (other_ && other_->mode == GoalMode::Go && rests_at(state, other_->position)) fly_to(step_, now);
    return;
  }
  if (stand_ == Stand::Flying || stand_ == Stand::Staying) judge(state, now);
}

void Progress::judge(const UavState& state, UTime now) {
  judge_missed(state, now);
  const Step& step = mission_.steps[idx(step_)];
  if (step.action == Action::Pass) return judge_pass(state, now);
  judge_stay(state, now);
  if (stand_ == Stand::Flying) judge_time(state, step.position + track_.value_or(Vec3::Zero()), now);
}

void Progress::judge_time(const UavState& state, const Vec3& place, UTime now) {
  Limits limits = limits_;
  if (speed_limit_) limits.v_max = speed_limit_->v_max;
  const double limit_s = time_limit_s(sent_from_, place, limits);
  if ((now - step_since_).seconds() <= limit_s) return;
  fail(fmt::format("{} was not reached within {:.0f} s: {:.1f} m are left", mission_.steps[idx(step_)].name, limit_s,
                   (place - state.motion.p).norm()),
       now);
}

void Progress::judge_pass(const UavState& state, UTime now) {
  const Step& step = mission_.steps[idx(step_)];
  const Vec3 way = step.position - state.motion.p;
  const double distance = way.norm(), radius = radius_of(step);
  if (distance <= radius) {
    reached_[idx(step_)] = now;
    return advance(now);
  }
  const double closing = way.dot(state.motion.v) / distance;
  if (!passes_late_ && !passing_ && distance - closing * kGoalLatency.seconds() <= radius) {
    passing_ = step_;
    return advance(now);
  }
  judge_time(state, step.position, now);
}

/// The waypoint behind: it counts once the vehicle is within the radius. If the vehicle turns away before, it returns.
void Progress::judge_missed(const UavState& state, UTime now) {
  if (!passing_) return;
  const Step& step = mission_.steps[idx(*passing_)];
  const Vec3 way = step.position - state.motion.p;
  if (way.norm() <= radius_of(step)) {
    reached_[idx(*passing_)] = now;
    passing_.reset();
  } else if (way.dot(state.motion.v) <= 0.0) {
    ++repeats_;
    passes_late_ = true;
    fly_to(*std::exchange(passing_, std::nullopt), now);
  }
}

void Progress::judge_stay(const UavState& state, UTime now) {
  const Step& step = mission_.steps[idx(step_)];
  if (step.action == Action::Follow && now - track_at_ > kTrackLost) {
    return fail(
        fmt::format("{}: track {} was not in PREDICTIONS for {:.0f} s", step.name, step.track, kTrackLost.seconds()),
        now);
  }
  if (stand_ == Stand::Flying) {
    const bool is_beside = track_ && (*track_ + step.position - state.motion.p).norm() <= kBeside;
    const bool is_there = step.action == Action::Follow ? is_beside : rests_at(state, step.position);
    if (!is_there) return;
    reached_[idx(step_)] = now;
    stay_since_ = now;
    stand_ = Stand::Staying;
  }
  if ((now - stay_since_).seconds() >= step.hold_s) advance(now);
}

std::optional<std::int64_t> Progress::followed_track() const {
  const Step& step = mission_.steps[idx(step_)];
  const bool is_flown = stand_ == Stand::Flying || stand_ == Stand::Staying;
  return is_flown && step.action == Action::Follow ? std::optional(step.track) : std::nullopt;
}

void Progress::receive_track(const Vec3& centre, UTime now) {
  if (!following_ || !followed_track()) return;
  track_at_ = now;
  const Vec3 place = centre + mission_.steps[idx(step_)].position;
  const bool is_first = !track_;
  track_ = centre;
  const bool has_moved = goal_ && (goal_->position - place).norm() > kTrackMoved;
  if (!is_first && (!has_moved || now - track_sent_ < kFollowPeriod)) return;
  track_sent_ = now;
  send(GoalMode::Go, place, now);
}

std::optional<Goal> Progress::due(UTime now) {
  if (!goal_ || now < next_goal_) return std::nullopt;
  next_goal_ = now + kGoalPeriod;
  return goal_;
}

UTime Progress::next_wakeup() const { return goal_ ? next_goal_ : UTime{std::numeric_limits<std::int64_t>::max()}; }

std::string Progress::text() const {
  const Step& step = mission_.steps[idx(step_)];
  std::string at = fmt::format("step {} of {}, {}", step_ + 1, mission_.steps.size(), step.name);
  switch (stand_) {
    case Stand::Waiting: return "the vehicle to follow its setpoints";
    case Stand::Flying:
      if (step.action == Action::Follow) return fmt::format("{}: track {}", at, step.track);
      return fmt::format("{}: {:.1f} m away", at, (step.position - position_).norm());
    case Stand::Staying: return fmt::format("{}: stays for {:g} s", at, step.hold_s);
    case Stand::Paused:
      if (!other_) return at + ": paused by an order";
      return fmt::format("{}: paused by {} {}", at, other_->mode == GoalMode::Go ? "a detour, goal" : "goal",
                         other_->id);
    case Stand::Done: return fmt::format("all {} steps are done", mission_.steps.size());
    case Stand::Failed: return why_failed_;
  }
  return at;
}

}  // namespace tern::mission
