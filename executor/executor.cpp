#include "executor/executor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/wire/message_limits.h"
#include "core/world/flyable.h"
#include "executor/commanded_motion.h"

namespace tern {
namespace {

/// Closed requests that are remembered: three seconds of them at 20 Hz; an answer later than that is unknown.
constexpr std::size_t kRemembered = 64;
/// A flight box that is widened grows by whole steps, m: the planner prepares its goal field for each one.
constexpr double kBoxStep = 0.25;
/// Plans that were adopted may leave the flight box by kBoxTolerance, m.
constexpr double kFlownOutside = 2.0 * kBoxTolerance;

Duration checked_period(double rate_hz) {
  if (!(rate_hz >= 1e-3 && rate_hz <= 1000.0)) {
    throw std::invalid_argument("rate_hz " + std::to_string(rate_hz) + " is not in [0.001, 1000]");
  }
  return {static_cast<std::int64_t>(std::ceil(1e6 / rate_hz))};
}

Duration checked_lead(Duration lead) {
  if (lead <= kDeadlineLead || lead > Duration{5'000'000}) {
    throw std::invalid_argument("lead " + std::to_string(lead.us) + " us is not in (5000, 5000000]");
  }
  return lead;
}

/// From a measured state to rest.
CommittedTrajectory stopping(const UavState& measured, const Limits& limits) {
  const MotionSample& m = measured.motion;
  if (m.v.isZero(0.0) && m.a.isZero(0.0)) return {m.p, measured.at};
  CommittedTrajectory committed(m.p, measured.at - Duration{1});
  committed.splice(braking_trajectory(m, measured.at, limits));
  return committed;
}

/// Returns the largest |v| per axis between t and t + dt, s, within one interval. There a is linear, so v is extreme at
/// an end, or where a is zero.
Vec3 largest_velocity(const ClampedSpline& spline, double t, double dt) {
  const MotionSample from = spline.sample(t);
  const MotionSample to = spline.sample(t + dt);
  const Vec3 a = from.a, change = to.a - a;
  Vec3 largest = from.v.cwiseAbs().cwiseMax(to.v.cwiseAbs());
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] * (a[axis] + change[axis]) >= 0.0) continue;
    const double extreme = from.v[axis] - 0.5 * dt * a[axis] * a[axis] / change[axis];
    largest[axis] = std::max(largest[axis], std::abs(extreme));
  }
  return largest;
}

}  // namespace

std::int64_t ExecutorCounters::refused() const {
  std::int64_t sum = 0;
  for (int k = 0; k < kVerdicts; ++k) {
    if (is_refusal(static_cast<Verdict>(k))) sum += verdicts[idx(k)];
  }
  return sum;
}

Executor::Executor(const UavSpec& uav, UTime now, const ExecutorConfig& config)
    : Executor(uav, UavState{.header = {}, .at = now, .motion = {.p = uav.start}}, config) {}

Executor::Executor(const UavSpec& uav, const UavState& measured, const ExecutorConfig& config)
    : limits_(uav.limits),
      body_(uav.body),
      flight_box_(uav.flight_box),
      period_(checked_period(config.rate_hz)),
      lead_(checked_lead(config.lead)),
      committed_(stopping(measured, uav.limits)),
      sent_start_(committed_.newest_start()) {}

void Executor::rejoin(const UavState& measured) {
  if (outstanding_) {
    ++counters_.unanswered;
    close(false);
  }
  committed_ = stopping(measured, limits_);
  sent_start_ = committed_.newest_start();
  tubes_.clear();
  last_request_.reset();
}

bool Executor::drop_unsent_plan(UTime last_setpoint) {
  const UTime start = committed_.newest_start();
  if (start <= sent_start_ || start <= last_setpoint) return false;
  committed_.drop_from(start);
  while (!tubes_.empty() && tubes_.back().from >= start) tubes_.pop_back();
  return true;
}

void Executor::set_tube(const Vec3& tube, double share) {
  tube_ = tube;
  share_ = share;
}

Vec3 Executor::tube_at(UTime t) const {
  const auto later = std::find_if(tubes_.begin(), tubes_.end(), [t](const TubeFrom& p) { return p.from > t; });
  return later == tubes_.begin() ? tube_ : std::prev(later)->tube;
}

void Executor::forget_before(UTime t) {
  committed_.forget_before(t);
  while (tubes_.size() > 1 && tubes_[1].from <= t) tubes_.pop_front();
}

Box Executor::flight_box_for(const TimedSpline& committed) const {
  const ClampedSpline spline = committed.spline();
  Box flown;
  for (int j = 0; j < spline.intervals(); ++j) flown.extend(spline.position_bounds(j));
  const Box allowed = centre_box(flight_box_, body_);
  Box box = flight_box_;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = allowed.min()[axis] - flown.min()[axis], above = flown.max()[axis] - allowed.max()[axis];
    if (below > kFlownOutside) box.min()[axis] = std::floor((box.min()[axis] - below) / kBoxStep) * kBoxStep;
    if (above > kFlownOutside) box.max()[axis] = std::ceil((box.max()[axis] + above) / kBoxStep) * kBoxStep;
  }
  return box;
}

Limits Executor::limits_for(const TimedSpline& committed, UTime from) const {
  const auto widened = [](const Vec3& limit, const Vec3& needed) {
    return Vec3((needed.array() > limit.array() * (1.0 + kLimitTolerance)).select(needed, limit));
  };
  const ClampedSpline spline = committed.spline();
  MotionBounds bounds;
  for (int j = 0; j < spline.intervals(); ++j) {
    if (committed.start + committed.interval * (j + 1) <= from) continue;
    const MotionBounds part = motion_bounds(spline, j);
    bounds.v_max = bounds.v_max.cwiseMax(part.v_max);
    bounds.a_max = bounds.a_max.cwiseMax(part.a_max);
    bounds.j_max = bounds.j_max.cwiseMax(part.j_max);
  }
  Limits limits{widened(share_ * limits_.v_max, bounds.v_max), widened(share_ * limits_.a_max, bounds.a_max),
                widened(share_ * limits_.j_max, bounds.j_max)};
  if (speed_limit_) limits.v_max = limits.v_max.cwiseMin(*speed_limit_);
  if (limits_.dynamics && breach_of(spline, *limits_.dynamics).ok()) limits.dynamics = limits_.dynamics;
  return limits;
}

bool Executor::is_too_fast(const TimedSpline& committed, UTime from) const {
  if (!speed_limit_) return false;
  const ClampedSpline spline = committed.spline();
  Vec3 fastest = Vec3::Zero();
  for (int j = 0; j < spline.intervals(); ++j) {
    const UTime begin = std::max(committed.start + committed.interval * j, from);
    const UTime end = committed.start + committed.interval * (j + 1);
    if (end <= from) continue;
    fastest = fastest.cwiseMax(largest_velocity(spline, (begin - committed.start).seconds(), (end - begin).seconds()));
  }
  return (fastest.array() > speed_limit_->array() * (1.0 + kLimitTolerance)).any();
}

void Executor::close(bool answered) {
  closed_.push_back({outstanding_->id, outstanding_->t_s, answered});
  if (closed_.size() > kRemembered) closed_.pop_front();
  outstanding_.reset();
}

void Executor::close_expired(UTime now) {
  if (!outstanding_ || now <= outstanding_->deadline) return;
  ++counters_.unanswered;
  close(false);
}

std::optional<UTime> Executor::next_wakeup() const {
  if (!requests_plans()) return std::nullopt;
  UTime due = last_request_ ? std::max(*requests_from_, *last_request_ + period_) : *requests_from_;
  if (outstanding_) due = std::max(due, outstanding_->deadline + Duration{1});
  return due;
}

std::optional<HorizonRequest> Executor::next_request(UTime now) {
  close_expired(now);
  const std::optional<UTime> due = next_wakeup();
  if (!due || now < *due) return std::nullopt;
  last_request_ = now;
  HorizonRequest request;
  request.t_s = now + lead_;
  request.committed = committed_.in_force_at(request.t_s);
  if (is_too_fast(request.committed, request.t_s)) return std::nullopt;
  request.id = ++counters_.requests;
  request.deadline = request.t_s - kDeadlineLead;
  request.start = committed_.sample(request.t_s);
  request.limits = limits_for(request.committed, request.t_s);
  request.body = body_;
  request.flight_box = flight_box_for(request.committed);
  request.tube = tube_;
  sent_start_ = request.committed.start;
  outstanding_ = request;
  return request;
}

MotionSample Executor::sample_after(UTime t) const {
  return sample_cubic(committed_.pieces(t, t + Duration{1}).pieces.front().coefficients, 0.0);
}

Verdict Executor::judge_closed(std::int64_t id, UTime now) {
  const auto found = std::find_if(closed_.begin(), closed_.end(), [id](const Closed& c) { return c.id == id; });
  if (found == closed_.end()) return Verdict::UnknownRequest;
  if (std::exchange(found->answered, true)) return Verdict::AnsweredTwice;
  return now < found->t_s ? Verdict::Late : Verdict::TooLate;
}

Adoption Executor::judge(const Plan& plan, UTime now) {
  if (!outstanding_ || plan.request_id != outstanding_->id) {
    return {judge_closed(plan.request_id, now), "request " + std::to_string(plan.request_id)};
  }
  ++counters_.answered_in_time;
  const HorizonRequest request = *outstanding_;
  close(true);
  if (plan.outcome == PlanOutcome::KeepCommitted) {
    tubes_.push_back({request.t_s, request.tube});
    return {Verdict::Kept, {}};
  }
  if (plan.outcome == PlanOutcome::NoPlan) return {Verdict::NoPlan, {}};
  if (!requests_plans()) return {Verdict::Stopped, "mode Stop, no goal, or the vehicle does not follow"};
  Adoption result = check_trajectory(plan.trajectory, request);
  if (result.verdict == Verdict::Adopted) {
    committed_.splice(plan.trajectory);
    tubes_.push_back({request.t_s, request.tube});
  }
  return result;
}

Adoption Executor::consider(const Plan& plan, UTime now) {
  close_expired(now);
  Adoption result = judge(plan, now);
  ++counters_.verdicts[idx(result.verdict)];
  if (result.verdict == Verdict::Unflyable) ++counters_.breaches[idx(result.breach)];
  return result;
}

}  // namespace tern
