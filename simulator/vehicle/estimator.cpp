#include "simulator/vehicle/estimator.h"

#include <cmath>
#include <numbers>

namespace tern {

EstimateNoise::EstimateNoise(const EstimatorSpec& spec, std::uint64_t seed) : spec_(spec), rng_(seed) {
  noise_ = spec.position_sigma_m * normal();
  velocity_ = spec.velocity_sigma * normal();
  bias_ = spec.drift_m * normal();
}

Vec3 EstimateNoise::normal() {
  const double x = rng_.normal(), y = rng_.normal(), z = rng_.normal();
  return {x, y, z};
}

void EstimateNoise::jump(double metres) {
  const double direction = rng_.uniform(0.0, 2.0 * std::numbers::pi);
  jump(metres * Vec3(std::cos(direction), std::sin(direction), 0.0));
}

void EstimateNoise::jump(const Vec3& by) {
  jumped_ += by;
  ++jumps_;
}

void EstimateNoise::advance(double dt) {
  const auto move = [&](Vec3& x, double sigma, double time_s) {
    const double keep = std::exp(-dt / time_s);
    x = keep * x + sigma * std::sqrt(1.0 - keep * keep) * normal();
  };
  move(noise_, spec_.position_sigma_m, spec_.noise_time_s);
  move(velocity_, spec_.velocity_sigma, spec_.noise_time_s);
  move(bias_, spec_.drift_m, spec_.drift_time_s);
  const double before = time_s_;
  time_s_ += dt;
  if (spec_.jump_m <= 0.0) return;
  const bool now = spec_.jump_at_s > before && spec_.jump_at_s <= time_s_;
  const bool drawn = spec_.jump_every_s > 0.0 && rng_.uniform() < dt / spec_.jump_every_s;
  if (now || drawn) jump(spec_.jump_m);
}

}  // namespace tern
