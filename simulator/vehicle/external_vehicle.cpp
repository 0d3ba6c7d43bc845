#include "simulator/vehicle/external_vehicle.h"

#include <limits>

namespace tern {
namespace {

constexpr Duration kRemembered{4'000'000};
/// States nearer to each other than this are one: their distance in time is mostly jitter of their stamps.
constexpr Duration kSameState{5'000};

}  // namespace

ExternalVehicle::ExternalVehicle(const UavSpec& uav, UTime now) : truth_(uav.start, now) {
  newest_.at = now;
  newest_.motion.p = uav.start;
}

void ExternalVehicle::append(const UavState& state) {
  if (!has_state_) {
    truth_ = MotionHistory(state.motion.p, state.at);
  } else if (state.at - newest_.at < kSameState) {
    return;
  } else {
    truth_.append(hermite_piece(newest_.motion, state.motion, state.at - newest_.at));
  }
  has_state_ = true;
  newest_ = state;
}

void ExternalVehicle::receive_truth(const UavState& state) {
  has_truth_ = true;
  append(state);
}

void ExternalVehicle::receive_estimate(const UavState& state) {
  if (!has_truth_) append(state);
}

void ExternalVehicle::advance(UTime now) { truth_.forget_before(now - kRemembered); }

VehicleStatus ExternalVehicle::status(UTime now) const {
  VehicleStatus status;
  status.at = now;
  status.why_not = "another process flies the vehicle";
  return status;
}

Limits ExternalVehicle::judged_limits() const {
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::infinity());
  return {none, none, none};
}

}  // namespace tern
