#include "executor/tube.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tern {
namespace {

constexpr double kSigmas = 3.0;
constexpr double kWider = 1.5;

double rounded_up(double width) {
  return width >= kNothing ? std::ceil(width / Tube::kTubeStep - 1e-9) * Tube::kTubeStep : 0.0;
}

}  // namespace

void Tube::add(const Vec3& error, bool rests, UTime at) {
  saw(error);
  Seconds& seconds = rests ? resting_ : moving_;
  if (seconds.empty() || at - seconds.back().start >= kSecond) seconds.push_back({at, Vec3::Zero()});
  seconds.back().largest = seconds.back().largest.cwiseMax(error);
  if (seconds.size() > kRemembered) seconds.pop_front();
}

void Tube::blocked(UTime at) {
  if (!has_error_ || halvings_ == kMostHalvings || !may_step(at)) return;
  ++halvings_;
  stepped_ = at;
}

void Tube::flown(UTime at) {
  if (halvings_ == 0 || !may_step(at)) return;
  --halvings_;
  stepped_ = at;
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

Vec3 Tube::width(const Vec3& sigma, UTime now) const {
  const double wider = left_ && now - *left_ < kWidened ? kWider : 1.0;
  Vec3 width;
  for (int axis = 0; axis < 3; ++axis) {
    const double unsure = kSigmas * sigma[axis];
    const double moving = kMargin * quantile(moving_, has_error_ ? kPriorError : 0.0, axis) + unsure;
    const double resting = kMargin * quantile(resting_, 0.0, axis) + unsure;
    const double whole = std::max(rounded_up(resting), share() * rounded_up(moving));
    width[axis] = std::clamp(std::max(whole, floor_m_) * wider, floor_m_, kWidestTube);
  }
  return width;
}

}  // namespace tern
