// The vehicle's state estimator: the truth with noise, a drifting bias, and jumps.
#pragma once

#include <cstdint>

#include "core/base/knobs.h"
#include "core/base/random.h"
#include "core/base/types.h"

namespace tern {

/// The section `estimator`. All zero: the estimate is the truth.
struct EstimatorSpec {
  double position_sigma_m = 0.0;
  double velocity_sigma = 0.0;
  double noise_time_s = 0.3;
  double drift_m = 0.0;
  double drift_time_s = 60.0;
  double latency_s = 0.0;
  double jump_m = 0.0;
  double jump_every_s = 0.0;
  double jump_at_s = 0.0;
  template <typename V>
  void visit(V& v) {
    v("position_sigma_m", position_sigma_m, Range{0.0, 100.0},
      "standard deviation of the position's noise per axis, m");
    v("velocity_sigma", velocity_sigma, Range{0.0, 100.0}, "standard deviation of the velocity's noise per axis, m/s");
    v("noise_time_s", noise_time_s, Range{1e-3, 1e3}, "correlation time of the noise of position and velocity, s");
    v("drift_m", drift_m, Range{0.0, 100.0}, "standard deviation of the position's bias per axis, m");
    v("drift_time_s", drift_time_s, Range{1.0, 1e5}, "correlation time of the bias, s");
    v("latency_s", latency_s, Range{0.0, 1.0},
      "delay of UAV_STATE after its time, s; the controller's estimate has no delay");
    v("jump_m", jump_m, Range{0.0, 100.0},
      "horizontal shift of the position at a reset of the estimator, in a random direction, m");
    v("jump_every_s", jump_every_s, Range{0.0, 1e6}, "mean time between resets, s; 0: only the one of `jump_at_s`");
    v("jump_at_s", jump_at_s, Range{0.0, 1e6}, "time of one reset after the vehicle's start, s; 0: none");
  }
};

/// Noise and bias are first-order Markov processes in their stationary state, and jumps add up. Deterministic from the
/// seed. The caller applies the latency.
class EstimateNoise {
 public:
  EstimateNoise(const EstimatorSpec& spec, std::uint64_t seed);
  void advance(double dt);
  [[nodiscard]] Vec3 position_error() const { return noise_ + bias_ + jumped_; }  ///< estimate − truth, m
  [[nodiscard]] Vec3 velocity_error() const { return velocity_; }                 ///< m/s
  /// Shifts the estimate horizontally by this distance, in a random direction.
  void jump(double metres);
  /// Shifts the estimate, m.
  void jump(const Vec3& by);
  [[nodiscard]] int jumps() const { return jumps_; }  ///< number so far

 private:
  Vec3 normal();
  EstimatorSpec spec_;
  Rng rng_;
  double time_s_ = 0.0;
  Vec3 noise_ = Vec3::Zero(), velocity_ = Vec3::Zero(), bias_ = Vec3::Zero(), jumped_ = Vec3::Zero();
  int jumps_ = 0;
};

}  // namespace tern
