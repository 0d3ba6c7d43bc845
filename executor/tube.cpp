#include "executor/tube.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tern {
namespace {

constexpr double kSigmas = 3.0;
/// Of the largest error, while there are too few seconds for the quantile.
constexpr double kFewFactor = 1.5;
constexpr double kWider = 1.5;

}  // namespace

void Tube::add(const Vec3& error, UTime at) {
  if (seconds_.empty() || at - seconds_.back().start >= kSecond) seconds_.push_back({at, Vec3::Zero()});
  seconds_.back().largest = seconds_.back().largest.cwiseMax(error);
  if (seconds_.size() > kRemembered) seconds_.pop_front();
}

double Tube::quantile(int axis) const {
  if (seconds_.empty()) return 0.0;
  std::vector<double> errors;
  for (const Second& second : seconds_) errors.push_back(second.largest[axis]);
  std::sort(errors.begin(), errors.end());
  const double n = static_cast<double>(errors.size());
  const auto rank = static_cast<std::size_t>(std::ceil((n + 1.0) * (1.0 - kMissed)));
  return rank > errors.size() ? kFewFactor * errors.back() : errors[rank - 1];
}

Vec3 Tube::width(const Vec3& sigma, UTime now) const {
  const double wider = left_ && now - *left_ < kWidened ? kWider : 1.0;
  Vec3 width;
  for (int axis = 0; axis < 3; ++axis) {
    const double measured = quantile(axis) + kSigmas * sigma[axis];
    const double steps = measured >= kNothing ? std::ceil(measured / kTubeStep) : 0.0;
    const double whole = std::max(steps * kTubeStep, floor_m_) * wider;
    width[axis] = std::clamp(std::ldexp(whole, -halvings_), floor_m_, kWidestTube);
  }
  return width;
}

}  // namespace tern
