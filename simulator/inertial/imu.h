// A simulated inertial sensor: the true motion with white noise and wandering biases.
#pragma once

#include <cstdint>

#include "core/base/knobs.h"
#include "core/base/random.h"
#include "simulator/inertial/strapdown.h"

namespace tern {

/// The section `simulator.vio.imu`. The defaults are noise as it is in flight. The Allan noise of data sheets is ten
/// times smaller for the force: vibration, scale and mounting errors are not in it.
struct ImuSpec {
  double force_noise = 2.8e-2;
  double force_walk = 3e-3;
  double rate_noise = 3.4e-4;
  double rate_walk = 1.94e-5;
  double force_bias = 0.03;
  double rate_bias = 2e-4;
  template <typename V>
  void visit(V& v) {
    v("force_noise", force_noise, Range{0.0, 10.0}, "density of the accelerometer's white noise, m/s²/√Hz");
    v("force_walk", force_walk, Range{0.0, 10.0}, "density of the random walk of its bias, m/s³/√Hz");
    v("rate_noise", rate_noise, Range{0.0, 1.0}, "density of the gyroscope's white noise, rad/s/√Hz");
    v("rate_walk", rate_walk, Range{0.0, 1.0}, "density of the random walk of its bias, rad/s²/√Hz");
    v("force_bias", force_bias, Range{0.0, 10.0}, "standard deviation of the accelerometer's bias at the start, m/s²");
    v("rate_bias", rate_bias, Range{0.0, 1.0}, "standard deviation of the gyroscope's bias at the start, rad/s");
  }
};

/// Makes measurements from true samples. A sample over h has white noise of standard deviation density/√h. Afterwards
/// each bias takes a normal step of density·√h. Deterministic from the seed.
class SimulatedImu {
 public:
  SimulatedImu(const ImuSpec& spec, std::uint64_t seed);
  InertialSample measure(const InertialSample& truth, double h_s);
  [[nodiscard]] const InertialSample& bias() const { return bias_; }  ///< of the next sample

 private:
  Vec3 normal(double sigma);
  ImuSpec spec_;
  Rng rng_;
  InertialSample bias_;
};

}  // namespace tern
