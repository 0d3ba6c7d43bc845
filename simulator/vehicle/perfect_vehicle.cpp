#include "simulator/vehicle/perfect_vehicle.h"

namespace tern {
namespace {

/// The longest time that anybody looks back: the sensor's latency and the referee's lag.
constexpr Duration kRemembered{4'000'000};
/// Setpoints come so late at most: a busy machine holds up the executor, then the thread that receives them. Truth that
/// has gone on along an older trajectory by then could only jump to the one that they are of.
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

VehicleStatus PerfectVehicle::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.armed = status.following = true;
  status.mode = kPerfectMode;
  return status;
}

}  // namespace tern
