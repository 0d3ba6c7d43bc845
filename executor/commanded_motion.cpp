#include "executor/commanded_motion.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/world/thrust.h"

namespace tern {
namespace {

/// Intervals of a braking trajectory, and the lengths of the ramps of its acceleration, in intervals.
constexpr int kBrakingIntervals = 16;
constexpr int kRamps[] = {1, 2, 4, 8};
constexpr Duration kMinBrakingInterval{5'000};  ///< of an interval
constexpr Duration kMaxBrakingInterval{1'250'000};
/// The next setpoint is due within this time: the command does not brake yet.
constexpr Duration kNextSetpoint{20'000};
/// A setpoint that is later than this after the one before is a departure.
constexpr Duration kSetpointGap{200'000};
/// After a silence, a departure of more than this must last for kDepartureTime, m.
constexpr double kFarDeparture = 0.1;
/// Within this time an executor has seen where the vehicle is, and leads on from there.
constexpr Duration kDepartureTime{500'000};

bool agree(const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff() <= kJoinTolerance; }

/// Compares position, velocity and acceleration. The jerk may jump.
bool agree(const MotionSample& a, const MotionSample& b) {
  return agree(a.p, b.p) && agree(a.v, b.v) && agree(a.a, b.a);
}

CubicPiece cubic_of(const MotionSample& from, Duration duration) {
  CubicPiece piece{duration, {}};
  piece.coefficients << from.j / 6.0, from.a / 2.0, from.v, from.p;
  return piece;
}

MotionSample start_of(const ClampedSpline& spline) {
  return sample_cubic(reparametrized(spline.power(0), 0.0, 1.0 / spline.interval_s()), 0.0);
}

/// Control points of a spline that leaves `from` with these accelerations at its knots (a column per knot, m/s²; the
/// first is from.a). The acceleration is linear between knots, so consecutive control points of the velocity differ by
/// a_k Δt, and the first and the last two by half of that.
/// @pre the accelerations bring it to rest: the last two control points of the velocity are set to zero
Points points_with(const MotionSample& from, const Points& accelerations, double interval_s) {
  const Eigen::Index intervals = accelerations.cols() - 1;
  Points q(3, intervals + 3);
  q.col(0) = from.p;
  Vec3 v = from.v;
  for (Eigen::Index k = 0; k <= intervals + 1; ++k) {
    const auto knots_ahead = std::min({k + 1, intervals + 2 - k, Eigen::Index{3}});
    q.col(k + 1) = q.col(k) + v * (interval_s * static_cast<double>(knots_ahead) / 3.0);
    if (k <= intervals) v += accelerations.col(k) * (interval_s * (k == 0 || k == intervals ? 0.5 : 1.0));
    if (k >= intervals - 1) v.setZero();
  }
  return q;
}

/// A trajectory from `from` to rest. from.a fades out within `ramp` intervals, with weights f_k. A second acceleration
/// c, with weights w_k that ramp up and down as long, removes the velocity: a_k = f_k from.a + w_k c, and v + Δt (a_0/2
/// + Σ a_k) = 0.
TimedSpline braking_in(const MotionSample& from, UTime at, Duration interval, int ramp) {
  Eigen::Matrix<double, 1, kBrakingIntervals + 1> fades, weights;
  for (int k = 0; k <= kBrakingIntervals; ++k) {
    fades[k] = std::max(0.0, 1.0 - static_cast<double>(k) / ramp);
    weights[k] = std::min({1.0, static_cast<double>(k) / ramp, static_cast<double>(kBrakingIntervals - k) / ramp});
  }
  const double dt = interval.seconds();
  const Vec3 c = -(from.v / dt + (fades.sum() - 0.5) * from.a) / weights.sum();
  return {at, interval, points_with(from, from.a * fades + c * weights, dt)};
}

/// Whether the second of two setpoints continues the first. Wide tolerances: a sender may leave out the jerk.
bool goes_on(const UavState& first, const UavState& second) {
  const Duration between = second.at - first.at;
  if (between <= Duration{0} || between > kSetpointGap) return false;
  const CubicPiece cubic = cubic_of(first.motion, between);
  const MotionSample there = sample_cubic(cubic.coefficients, between.seconds());
  const MotionSample& m = second.motion;
  return (there.p - m.p).norm() <= 0.05 && (there.v - m.v).norm() <= 0.5 && (there.a - m.a).norm() <= 10.0;
}

double share_of(const Dynamics& dynamics, const ClampedSpline& spline) {
  double share = 0.0;
  for (int j = 0; j < spline.intervals(); ++j) {
    const ThrustBounds b = thrust_bounds(spline, j);
    share =
        std::max({share, dynamics.thrust_min / b.min_thrust, b.max_thrust / dynamics.thrust_max,
                  b.slope / tilt_slope(dynamics.tilt_max_deg), b.body_rate / to_radians(dynamics.body_rate_max_deg_s)});
  }
  return share;
}

/// The largest ratio of a value to its limit, over axes, derivatives and dynamics. All limits are kept if it is at most
/// 1 + kLimitTolerance.
double share_of(const Limits& limits, const TimedSpline& trajectory) {
  const ClampedSpline spline = trajectory.spline();
  const MotionBounds bounds = motion_bounds(spline);
  const double share = std::max({bounds.v_max.cwiseQuotient(limits.v_max).maxCoeff(),
                                 bounds.a_max.cwiseQuotient(limits.a_max).maxCoeff(),
                                 bounds.j_max.cwiseQuotient(limits.j_max).maxCoeff()});
  return limits.dynamics ? std::max(share, share_of(*limits.dynamics, spline)) : share;
}

struct Braking {
  TimedSpline trajectory;
  double share = std::numeric_limits<double>::infinity();
};

/// The shortest candidate that keeps the limits, or the one that exceeds them least.
Braking best_braking(const MotionSample& from, UTime at, const Limits& limits) {
  Braking best;
  for (Duration interval = kMinBrakingInterval; interval <= kMaxBrakingInterval; interval.us += interval.us / 8) {
    for (const int ramp : kRamps) {
      TimedSpline stop = braking_in(from, at, interval, ramp);
      const double share = share_of(limits, stop);
      if (share < best.share || best.share == std::numeric_limits<double>::infinity()) best = {std::move(stop), share};
      if (share <= 1.0 + kLimitTolerance) return best;
    }
  }
  return best;
}

}  // namespace

TimedSpline braking_trajectory(const MotionSample& from, UTime at, const Limits& limits) {
  const Braking best = best_braking(from, at, limits);
  if (!limits.dynamics || best.share <= 1.0 + kLimitTolerance) return best.trajectory;
  return best_braking(from, at, {limits.v_max, limits.a_max, limits.j_max}).trajectory;
}

CommandedMotion::CommandedMotion(const Vec3& p, UTime from, const Limits& limits)
    : limits_(limits), settled_(p, from), newest_{.p = p}, received_until_(from), committed_(p, from) {}

CommandedMotion::CommandedMotion(const UavState& setpoint, const Limits& limits)
    : CommandedMotion(setpoint.motion.p, setpoint.at, limits) {
  yaw_ = setpoint.yaw;
  choose_continuation(setpoint.motion, setpoint.at);
}

void CommandedMotion::receive(const UavState& setpoint) {
  const UTime end = settled_.end();
  if (setpoint.at <= end) return;
  const CubicPiece cubic = cubic_of(newest_, setpoint.at - end);
  const MotionSample by_cubic = sample_cubic(cubic.coefficients, cubic.duration.seconds());
  const MotionSample by_committed = continuation().sample(setpoint.at);
  const bool is_soon = setpoint.at - end <= kSetpointGap;
  if (!is_soon || !(agree(by_cubic, setpoint.motion) || agree(by_committed, setpoint.motion))) {
    if (!accepts_departure(setpoint, (by_committed.p - setpoint.motion.p).norm() > kFarDeparture)) return;
  }
  departure_.reset();
  if (agree(by_cubic, setpoint.motion) || !agree(by_committed, setpoint.motion)) {
    settled_.append(cubic);
  } else {
    settled_.append(continuation().pieces(end, setpoint.at));
  }
  received_until_ = setpoint.at;
  yaw_ = setpoint.yaw;
  choose_continuation(setpoint.motion, setpoint.at);
}

bool CommandedMotion::accepts_departure(const UavState& setpoint, bool is_far) {
  const std::optional<UavState> before = std::exchange(departure_, setpoint);
  if (!before || !goes_on(*before, setpoint)) {
    departed_since_ = setpoint.at;
    return false;
  }
  const bool was_silent = setpoint.at - received_until_ > kSetpointSilence;
  return !(was_silent && is_far) || setpoint.at - departed_since_ >= kDepartureTime;
}

void CommandedMotion::receive(const TimedSpline& committed) {
  planned_.reset();
  const ClampedSpline spline = committed.spline();
  if (!spline.ends_at_rest()) return;
  if (committed.start <= committed_.newest_start()) {
    const bool is_old = committed.start == committed_.newest_start() || committed.start < settled_.end();
    if (is_old || !agree(committed_.sample(committed.start), start_of(spline))) return;
    committed_.drop_from(committed.start);
  }
  const bool is_led_to = departure_ && departure_->at >= committed.start &&
                         agree(spline.sample((departure_->at - committed.start).seconds()), departure_->motion);
  const bool joins = braking_ || is_led_to || agree(committed_.sample(committed.start), start_of(spline));
  if (committed.start > committed_.newest_start() && joins) committed_.splice(committed);
  committed_.forget_before(settled_.end());
  if (braking_) choose_continuation(newest_, settled_.end());
}

void CommandedMotion::receive(const Plan& plan) {
  if (plan.outcome == PlanOutcome::NoPlan || plan.outcome == PlanOutcome::KeepCommitted || braking_) return;
  const TimedSpline& planned = plan.trajectory;
  if (planned.start < settled_.end()) return;
  ClampedSpline spline = planned.spline();
  if (agree(committed_.sample(planned.start), start_of(spline))) planned_ = {planned.start, std::move(spline)};
}

void CommandedMotion::choose_continuation(const MotionSample& motion, UTime at) {
  newest_ = motion;
  braking_.reset();
  if (agree(committed_.sample(at), motion)) return;
  const TimedSpline stop = braking_trajectory(motion, at, limits_);
  braking_.emplace(motion.p, at - Duration{1});
  braking_->splice(stop);
}

MotionSample CommandedMotion::sample(UTime t) const {
  if (t < settled_.end()) return settled_.sample(t);
  const Duration later = t - received_until_;
  if (braking_ && settled_.end() == received_until_ && later <= kNextSetpoint) {
    return sample_cubic(cubic_of(newest_, kNextSetpoint).coefficients, later.seconds());
  }
  return continuation().sample(t);
}

Vec3 CommandedMotion::acceleration_ahead(UTime t, Duration lead) const {
  const UTime then = t + lead;
  if (planned_ && t < planned_->start && then >= planned_->start) {
    return planned_->spline.sample((then - planned_->start).seconds()).a;
  }
  if (is_committed()) return sample(then).a;
  const MotionSample m = sample(t);
  return m.a + lead.seconds() * m.j;
}

bool CommandedMotion::settle(UTime until) {
  const UTime end = settled_.end();
  if (until <= end) return false;
  settled_.append(continuation().pieces(end, until));
  newest_ = continuation().sample(until);
  return true;
}

}  // namespace tern
