#include "simulator/vehicle/perfect_vehicle.h"

#include "simulator/vehicle/attitude.h"

namespace tern {
namespace {

/// History that the sensor's latency and the referee's lag need.
constexpr Duration kRemembered{4'000'000};
/// Largest delay of a setpoint: a busy machine holds up the executor and the receiving thread. A truth that had already
/// continued along the older trajectory would jump to the late setpoint.
constexpr Duration kLatest{500'000};

}  // namespace

void PerfectVehicle::advance(UTime now) {
  command_.settle(now - kLatest);
  command_.forget_before(now - kRemembered);
}

UavState PerfectVehicle::state_at(UTime t) const {
  UavState state;
  state.at = t;
  state.motion = command_.sample(t);
  state.yaw = command_.yaw();
  return state;
}

Eigen::Quaterniond PerfectVehicle::attitude() const {
  const UavState state = true_state();
  return attitude_of(state.motion.a, state.yaw);
}

VehicleStatus PerfectVehicle::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.armed = status.following = true;
  status.mode = kPerfectMode;
  return status;
}

}  // namespace tern
