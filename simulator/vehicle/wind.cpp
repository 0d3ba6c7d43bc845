#include "simulator/vehicle/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern {

Turbulence turbulence_of(const WindSpec& spec) {
  constexpr double kFeet = 0.3048;
  const double bracket = 0.177 + 0.000823 * spec.height_m / kFeet;
  const double up = 0.1 * spec.speed * spec.gusts;
  const double level = up / std::pow(bracket, 0.4), length = spec.height_m / std::pow(bracket, 1.2);
  return {Vec3(level, level, up), Vec3(length, length, spec.height_m)};
}

Wind::Wind(const WindSpec& spec, std::uint64_t seed) : spec_(spec), turbulence_(turbulence_of(spec)), rng_(seed) {
  along_ = turbulence_.sigma.x() * rng_.normal();
}

void Wind::advance(double airspeed, double dt) {
  time_s_ += dt;
  const double speed = std::max(airspeed, 1.0);
  const double keep = std::exp(-speed / turbulence_.length.x() * dt);
  along_ = keep * along_ + turbulence_.sigma.x() * std::sqrt(1.0 - keep * keep) * rng_.normal();
  // (1 + √3 T s) / (1 + T s)² = √3 / (1 + T s) + (1 − √3) / (1 + T s)²: both in a chain of two first-order stages.
  for (int k = 0; k < 2; ++k) {
    const double rate = speed / turbulence_.length[k + 1];
    const double noise = turbulence_.sigma[k + 1] * std::sqrt(1.0 / (rate * dt)) * rng_.normal();
    slow_[k] += rate * dt * (noise - slow_[k]);
    gust_[k] += rate * dt * (slow_[k] - gust_[k]);
  }
}

Vec3 Wind::mean() const { return spec_.speed * Vec3(std::cos(spec_.towards), std::sin(spec_.towards), 0.0); }

Vec3 Wind::velocity() const {
  const Vec3 along(std::cos(spec_.towards), std::sin(spec_.towards), 0.0);
  const Vec3 across(-along.y(), along.x(), 0.0);
  const Eigen::Array2d second = std::numbers::sqrt3 * slow_ + (1.0 - std::numbers::sqrt3) * gust_;
  Vec3 air = mean() + along_ * along + second[0] * across + second[1] * Vec3::UnitZ();
  const double since = time_s_ - spec_.burst_at_s;
  if (since > 0.0 && since < spec_.burst_lasts_s) {
    const double shape = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * since / spec_.burst_lasts_s));
    air += spec_.burst * shape * Vec3(std::cos(spec_.burst_towards), std::sin(spec_.burst_towards), 0.0);
  }
  return air;
}

}  // namespace tern
