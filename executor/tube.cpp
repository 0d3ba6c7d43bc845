#include "executor/tube.h"

#include <cmath>
#include <vector>

namespace tern {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kWider = 1.5;

double rounded_up(double width) {
  return width >= kMinError ? std::ceil(width / Tube::kTubeStep - 1e-9) * Tube::kTubeStep : 0.0;
}

/// There is no way out of here.
bool is_blocked(const Plan& plan) {
  if (plan.outcome != PlanOutcome::NoPlan && plan.outcome != PlanOutcome::KeepCommitted) return false;
  return plan.reason == PlanReason::Infeasible || plan.reason == PlanReason::StartInCollision ||
         plan.reason == PlanReason::GoalBlocked;
}

}  // namespace

Vec3 PersistentError::add(const Vec3& error, UTime received) {
  newest_.push_back({received, error});
  while (newest_.size() > kMinStates && received - newest_[1].received >= kWindow) newest_.pop_front();
  if (newest_.size() < kMinStates) return Vec3::Zero();
  Vec3 least = error;
  for (const Seen& seen : newest_) least = least.cwiseMin(seen.error);
  return least;
}

void Tube::on_answer(const Plan& plan, bool rests, UTime at) {
  if (plan.outcome != PlanOutcome::NoPlan && plan.outcome != PlanOutcome::KeepCommitted) speed_up(at);
  if (rests && is_blocked(plan)) slow_down(plan.reason == PlanReason::StartInCollision, at);
}

void Tube::add(const Vec3& error, bool rests, UTime at) {
  note_error(error);
  Seconds& seconds = rests ? resting_ : moving_[idx(halvings_)];
  if (seconds.empty() || at - seconds.back().start >= kSecond) seconds.push_back({at, Vec3::Zero()});
  seconds.back().largest = seconds.back().largest.cwiseMax(error);
  if (seconds.size() > kMaxSeconds) seconds.pop_front();
}

void Tube::forget_since(UTime since) {
  if (forgot_ && since - *forgot_ < kComesBack) return;
  forgot_ = since;
  const auto forget = [&](Seconds& seconds) {
    while (!seconds.empty() && seconds.back().start + kSecond > since) seconds.pop_back();
  };
  std::for_each(moving_.begin(), moving_.end(), forget);
  forget(resting_);
  if (exited_ && *exited_ >= since) exited_.reset();
}

void Tube::slow_down(bool lies_in_floor, UTime at) {
  const bool shrinks_floor = lies_in_floor && floor_m_ > 0.0;
  if (!(has_error_ || shrinks_floor) || halvings_ == kMaxHalvings || !unchanged_for(kStepPeriod, at)) return;
  if (stepped_up_) patience_ = unchanged_for(patience(), at) ? kPatience : std::min(patience_ * 2, kMaxPatience);
  ++halvings_;
  if (shrinks_floor) ++floor_halvings_;
  stepped_up_ = false;
  stepped_ = at;
}

void Tube::speed_up(UTime at) {
  if (halvings_ == 0 || !unchanged_for(patience(), at)) return;
  --halvings_;
  floor_halvings_ = std::min(floor_halvings_, halvings_);
  stepped_up_ = true;
  stepped_ = at;
}

void Tube::add_shift(const Vec3& by) {
  shift_ += by;
  min_shift_ = min_shift_.cwiseMin(shift_);
  max_shift_ = max_shift_.cwiseMax(shift_);
}

double Tube::share() const { return std::ldexp(1.0, -halvings_); }

double Tube::floor_m() const { return std::ldexp(floor_m_, -floor_halvings_); }

double Tube::quantile(const Seconds& seconds, double prior, int axis) {
  std::vector<double> errors;
  for (const Second& second : seconds) errors.push_back(second.largest[axis]);
  errors.resize(std::max(errors.size(), kPriorSeconds), prior);
  std::sort(errors.begin(), errors.end());
  const double n = static_cast<double>(errors.size());
  return errors[static_cast<std::size_t>(std::ceil((n + 1.0) * (1.0 - kMissedShare))) - 1];
}

double Tube::moving_width(int axis, double unsure) const {
  double width = 0.0;
  for (int k = 0; k <= halvings_; ++k) {
    const double prior = k == 0 && has_error_ ? kPriorError : 0.0;
    width = std::max(width / 2.0, rounded_up(kMargin * quantile(moving_[idx(k)], prior, axis) + unsure));
  }
  return width;
}

Vec3 Tube::width(const Vec3& sigma, UTime now) const {
  const double wider = exited_ && now - *exited_ < kWidenedFor ? kWider : 1.0;
  const Vec3 in_doubt = (max_shift_ - shift_).cwiseMax(shift_ - min_shift_);
  Vec3 width;
  for (int axis = 0; axis < 3; ++axis) {
    const double unsure = kSigmas * sigma[axis];
    const double resting = rounded_up(kMargin * quantile(resting_, 0.0, axis) + unsure);
    const double whole = std::max({resting, moving_width(axis, unsure), floor_m()});
    width[axis] = std::min(wider * whole + in_doubt[axis], kMaxTube);
  }
  return width;
}

}  // namespace tern
