#include "executor/tube.h"

#include <cmath>
#include <vector>

namespace tern {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kWider = 1.5;

double rounded_up(double width) {
  return width >= kNothing ? std::ceil(width / Tube::kTubeStep - 1e-9) * Tube::kTubeStep : 0.0;
}

/// There is no way out of here.
bool is_blocked(const Plan& plan) {
  if (plan.outcome != PlanOutcome::NoPlan && plan.outcome != PlanOutcome::KeepCommitted) return false;
  return plan.reason == PlanReason::Infeasible || plan.reason == PlanReason::StartInCollision ||
         plan.reason == PlanReason::GoalBlocked;
}

}  // namespace

Vec3 LastingError::add(const Vec3& error, UTime received) {
  newest_.push_back({received, error});
  while (newest_.size() > kFewest && received - newest_[1].received >= kLasting) newest_.pop_front();
  if (newest_.size() < kFewest) return Vec3::Zero();
  Vec3 least = error;
  for (const Seen& seen : newest_) least = least.cwiseMin(seen.error);
  return least;
}

void Tube::answered(const Plan& plan, bool rests, UTime at) {
  if (plan.outcome != PlanOutcome::NoPlan && plan.outcome != PlanOutcome::KeepCommitted) flown(at);
  if (rests && is_blocked(plan)) blocked(at);
}

void Tube::add(const Vec3& error, bool rests, UTime at) {
  saw(error);
  Seconds& seconds = rests ? resting_ : moving_[idx(halvings_)];
  if (seconds.empty() || at - seconds.back().start >= kSecond) seconds.push_back({at, Vec3::Zero()});
  seconds.back().largest = seconds.back().largest.cwiseMax(error);
  if (seconds.size() > kRemembered) seconds.pop_front();
}

void Tube::blocked(UTime at) {
  if (!has_error_ || halvings_ == kMostHalvings || !stands_for(kStep, at)) return;
  if (stepped_up_) patience_ = stands_for(patience(), at) ? kPatience : std::min(patience_ * 2, kMostPatience);
  ++halvings_;
  stepped_up_ = false;
  stepped_ = at;
}

void Tube::flown(UTime at) {
  if (halvings_ == 0 || !stands_for(patience(), at)) return;
  --halvings_;
  stepped_up_ = true;
  stepped_ = at;
}

void Tube::shifted(const Vec3& by) {
  shift_ += by;
  least_shift_ = least_shift_.cwiseMin(shift_);
  most_shift_ = most_shift_.cwiseMax(shift_);
}

double Tube::share() const { return std::ldexp(1.0, -halvings_); }

double Tube::quantile(const Seconds& seconds, double prior, int axis) {
  std::vector<double> errors;
  for (const Second& second : seconds) errors.push_back(second.largest[axis]);
  errors.resize(std::max(errors.size(), kPrior), prior);
  std::sort(errors.begin(), errors.end());
  const double n = static_cast<double>(errors.size());
  return errors[static_cast<std::size_t>(std::ceil((n + 1.0) * (1.0 - kMissed))) - 1];
}

double Tube::moving(int axis, double unsure) const {
  double width = 0.0;
  for (int k = 0; k <= halvings_; ++k) {
    const double prior = k == 0 && has_error_ ? kPriorError : 0.0;
    width = std::max(width / 2.0, rounded_up(kMargin * quantile(moving_[idx(k)], prior, axis) + unsure));
  }
  return width;
}

Vec3 Tube::width(const Vec3& sigma, UTime now) const {
  const double wider = left_ && now - *left_ < kWidened ? kWider : 1.0;
  const Vec3 in_doubt = (most_shift_ - shift_).cwiseMax(shift_ - least_shift_);
  Vec3 width;
  for (int axis = 0; axis < 3; ++axis) {
    const double unsure = kSigmas * sigma[axis];
    const double resting = rounded_up(kMargin * quantile(resting_, 0.0, axis) + unsure);
    const double whole = std::max({resting, moving(axis, unsure), floor_m_});
    width[axis] = std::min(wider * whole + in_doubt[axis], kWidestTube);
  }
  return width;
}

}  // namespace tern
