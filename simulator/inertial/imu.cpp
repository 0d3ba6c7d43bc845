#include "simulator/inertial/imu.h"

#include <cmath>

namespace tern {

SimulatedImu::SimulatedImu(const ImuSpec& spec, std::uint64_t seed) : spec_(spec), rng_(seed) {
  bias_.rate = normal(spec.rate_bias);
  bias_.force = normal(spec.force_bias);
}

Vec3 SimulatedImu::normal(double sigma) {
  const double x = rng_.normal(), y = rng_.normal(), z = rng_.normal();
  return sigma * Vec3(x, y, z);
}

InertialSample SimulatedImu::measure(const InertialSample& truth, double h_s) {
  const double root = std::sqrt(h_s);
  InertialSample measured;
  measured.rate = truth.rate + bias_.rate + normal(spec_.rate_noise / root);
  measured.force = truth.force + bias_.force + normal(spec_.force_noise / root);
  bias_.rate += normal(spec_.rate_walk * root);
  bias_.force += normal(spec_.force_walk * root);
  return measured;
}

}  // namespace tern
