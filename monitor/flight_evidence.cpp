#include "monitor/flight_evidence.h"

#include <algorithm>
#include <limits>

#include "core/geometry/box.h"
#include "core/scenario/setting.h"
#include "core/world/body.h"
#include "monitor/request_ledger.h"

namespace tern {
namespace {

/// Smoothing of the sensor's delay: the mean of some ten frames.
constexpr double kShare = 0.1;
/// Most processes that are remembered: forged heartbeats must not fill the memory.
constexpr std::size_t kMaxProcesses = 256;

void note(std::map<std::string, Complaint>& complaints, const std::string& name, UTime at, const std::string& text) {
  const auto [found, is_new] = complaints.try_emplace(name, Complaint{at, at, text});
  found->second.heard = at;
  found->second.text = text;
}

}  // namespace

void Covered::note(const Track& there, std::int64_t set) {
  if (last_set != set) ++covered;
  last_set = set;
  track = there.id;
  kind = there.kind;
}

void FlightEvidence::receive(const TrackSet& predictions) {
  predictions_made_ = std::max(predictions_made_, predictions.made_at);
  if (!last_request_) return;
  if (predictions.batch.index == 0) ++goal_covered_.sets, ++start_covered_.sets;
  const Vec3 body = last_request_->body.half_extents();
  for (const Track& track : predictions.tracks) {
    const UTime at = std::clamp(predictions.made_at, track.motion.start, track.motion.end());
    const Vec3 p = track.motion.sample(at).p;
    const Vec3 whole = track.half_extents + body;
    if (box_around(p, whole).contains(goal_)) goal_covered_.note(track, predictions.batch.set);
    const Vec3 wide = whole + last_request_->tube + track.alpha[track.motion.locate(at).index];
    if (box_around(p, wide).contains(last_request_->start.p)) start_covered_.note(track, predictions.batch.set);
  }
}

void FlightEvidence::note_progress(UTime at) {
  progress_at_ = at;
  goal_covered_ = start_covered_ = {};
}

void FlightEvidence::receive(const Heartbeat& heartbeat) {
  const UTime at = heartbeat.header.utime;
  newest_ = std::max(newest_, at);
  if (!heard_.contains(heartbeat.process) && heard_.size() >= kMaxProcesses) return;
  heard_[heartbeat.process] = at;
  if (heartbeat.state == ProcessState::Ready || heartbeat.state == ProcessState::Finished) {
    not_ready_.erase(heartbeat.process);
  } else {
    note(not_ready_, heartbeat.process, at, heartbeat.waiting_for.empty() ? "starting" : heartbeat.waiting_for);
  }
  if (heartbeat.waiting_for.find("overloaded") != std::string::npos) {
    note(overloaded_, heartbeat.process, at, heartbeat.waiting_for);
  }
  const bool is_blocked = heartbeat.waiting_for.find(" is blocked: ") != std::string::npos;
  if (heartbeat.process == "tern-planner") blocked_goal_ = is_blocked ? heartbeat.waiting_for : "";
}

void FlightEvidence::receive(const UavState& state) {
  newest_ = std::max(newest_, state.header.utime);
  if (state_ && state.at <= state_->at) return;
  if (!state_ || state.motion.p != state_->motion.p || state.motion.v != state_->motion.v) same_since_ = state.at;
  state_ = state;
  settle(state.header.utime);
  const Vec3& p = state.motion.p;
  if (!anchor_ || (p - anchor_->motion.p).norm() > kStandRadius) {
    anchor_ = state;
    slow_since_.reset();
  }
  if (!slow_since_ && state.motion.v.norm() < kStandSpeed) slow_since_ = state.at;
  const double left_m = (goal_ - p).norm();
  if (left_m > closest_m_ - kProgress && begun_) return;
  closest_m_ = std::min(closest_m_, left_m);
  note_progress(state.at);
}

void FlightEvidence::receive(const VehicleStatus& status) {
  newest_ = std::max(newest_, status.header.utime);
  status_ = status;
  has_followed_ = has_followed_ || status.following;
  if (status.following || !has_followed_) {
    not_following_.reset();
  } else if (not_following_) {
    not_following_->heard = status.header.utime;
  } else {
    not_following_ = {status.header.utime, status.header.utime, status.why_not};
  }
}

void FlightEvidence::receive(const Goal& goal) {
  newest_ = std::max(newest_, goal.header.utime);
  is_held_ = goal.mode != GoalMode::Go;
  if (is_held_) return;
  if (goal.position == goal_) return;
  goal_ = goal.position;
  closest_m_ = state_ ? (goal_ - state_->motion.p).norm() : (goal_ - start_).norm();
  note_progress(goal.header.utime);
}

/// A network may deliver a request again, also after its answer.
void FlightEvidence::receive(const HorizonRequest& request) {
  const bool is_again = last_request_ && request.id <= last_request_->id &&
                        request.header.name.sender_epoch_us == last_request_->header.name.sender_epoch_us;
  if (is_again) return;
  newest_ = std::max(newest_, request.header.utime);
  if (!begun_ && !is_held_) begun_ = progress_at_ = request.header.utime;
  const double never = std::numeric_limits<double>::infinity();
  open_[request.id] = {request.deadline,
                       predictions_made_ == UTime{} ? never : (request.header.utime - predictions_made_).seconds()};
  last_request_ = request;
}

void FlightEvidence::receive(const Plan& plan) {
  newest_ = std::max(newest_, plan.header.utime);
  const auto asked = open_.find(plan.request_id);
  if (asked == open_.end()) return;
  answers_.push_back({plan.header.utime, plan.outcome, plan.reason, plan.header.utime <= asked->second.deadline,
                      asked->second.predictions_age_s});
  open_.erase(asked);
}

void FlightEvidence::settle(UTime vehicle_time) {
  std::erase_if(open_, [&](const auto& asked) {
    const Open& request = asked.second;
    if (request.deadline + kAnswerGrace >= vehicle_time) return false;
    answers_.push_back({request.deadline, PlanOutcome::NoPlan, PlanReason::None, false, request.predictions_age_s});
    return true;
  });
}

void FlightEvidence::receive(const ObservationSet& observations) {
  const double late_s = (observations.header.utime - observations.at).seconds();
  sensor_late_s_ = sensor_late_s_ ? (1.0 - kShare) * *sensor_late_s_ + kShare * late_s : late_s;
}

void FlightEvidence::receive(const ConfigurationReport& report) {
  const std::string text = setting(report.yaml, "planner.stale_after_s");
  if (!text.empty()) stale_after_s_ = std::strtod(text.c_str(), nullptr);
}

std::optional<UTime> FlightEvidence::stood_since() const {
  if (slow_since_ && state_->at - *slow_since_ >= kStandTime) return slow_since_;
  if (anchor_ && state_->at - anchor_->at >= kHoverTime) return anchor_->at;
  return std::nullopt;
}

std::optional<UTime> FlightEvidence::frozen_since() const {
  if (!state_ || state_->at - same_since_ < kStandTime) return std::nullopt;
  const MotionSample& stated = state_->motion;
  const bool moves = stated.v.norm() > kStandSpeed;
  const bool is_left = last_request_ && (last_request_->start.p - stated.p).norm() > kStandRadius;
  return moves || is_left ? std::optional(same_since_) : std::nullopt;
}

std::optional<std::pair<std::string, UTime>> FlightEvidence::silent_process() const {
  std::optional<std::pair<std::string, UTime>> first;
  for (const auto& [process, heard] : heard_) {
    if (process == "tern-logger" || process == "tern-monitor" || process == "tern-viewer") continue;
    if (newest_ - heard > kProcessSilence && (!first || heard < first->second)) first = {process, heard};
  }
  return first;
}

}  // namespace tern
