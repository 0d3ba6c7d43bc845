// The wind: a mean, Dryden's gusts, and one discrete gust.
#pragma once

#include <cstdint>

#include "core/base/knobs.h"
#include "core/base/random.h"
#include "core/base/types.h"

namespace tern {

struct WindSpec {
  double speed = 0.0;
  double towards = 0.0;
  double gusts = 1.0;
  double height_m = 6.1;
  double burst = 0.0;
  double burst_towards = 0.0;
  double burst_at_s = 10.0;
  double burst_lasts_s = 1.0;
  template <typename V>
  void visit(V& v) {
    v("speed", speed, Range{0.0, 60.0}, "horizontal speed of the mean wind, m/s");
    v("towards", towards, Range::within(7.0), "direction to which the mean wind blows, from W's x, rad");
    v("gusts", gusts, Range{0.0, 5.0},
      "strength of Dryden's turbulence at low altitude; 1: that of this mean wind, 0: none");
    v("height_m", height_m, Range{3.0, 300.0}, "height above the ground that the turbulence is computed for, m");
    v("burst", burst, Range{0.0, 60.0}, "peak of one discrete horizontal gust, m/s");
    v("burst_towards", burst_towards, Range::within(7.0),
      "direction to which the discrete gust blows, from W's x, rad");
    v("burst_at_s", burst_at_s, Range{0.0, 1e6}, "beginning of the discrete gust, s after the vehicle's start");
    v("burst_lasts_s", burst_lasts_s, Range::positive(1e3), "duration of the discrete gust, s");
  }
};

/// Standard deviations (m/s) and lengths (m) of Dryden's turbulence: along the wind, across it, vertical.
struct Turbulence {
  Vec3 sigma, length;
};
/// MIL-F-8785C, low altitude: σ_w = 0.1 V, σ_u = σ_v = σ_w / (0.177 + 0.000823 h)^0.4, L_w = h,
/// L_u = L_v = h / (0.177 + 0.000823 h)^1.2, h in feet.
Turbulence turbulence_of(const WindSpec& spec);

/// Dryden's filters driven by white noise, for a vehicle with a given airspeed: first order along the wind, second
/// order across and vertical. The discrete gust has a 1 − cosine shape (MIL-F-8785C). Deterministic from the seed.
class Wind {
 public:
  Wind(const WindSpec& spec, std::uint64_t seed);
  /// Advances by dt (s, far shorter than length / airspeed). @param airspeed  m/s, ≥ 0; below 1 it counts as 1
  void advance(double airspeed, double dt);
  /// The wind's velocity in W, m/s.
  [[nodiscard]] Vec3 velocity() const;
  /// The mean wind in W, m/s.
  [[nodiscard]] Vec3 mean() const;

 private:
  WindSpec spec_;
  Turbulence turbulence_;
  Rng rng_;
  double time_s_ = 0.0;
  double along_ = 0.0;  ///< state of the first-order filter, m/s
  Eigen::Array2d slow_ = Eigen::Array2d::Zero(),
                 gust_ = Eigen::Array2d::Zero();  // of the second-order ones: across, up
};

}  // namespace tern
