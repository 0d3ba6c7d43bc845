#include "simulator/vehicle/external_vehicle.h"

#include <algorithm>
#include <limits>

namespace tern {
namespace {

constexpr Duration kRemembered{4'000'000};
/// States nearer to each other than this are one: their distance in time is mostly jitter of their stamps.
constexpr Duration kSameState{5'000};

/// No vehicle covers more than kJump, m, at more than twice the speed of the states around it plus kJumpSpeed, m/s.
constexpr double kJump = 0.3, kJumpSpeed = 10.0;

/// True if no motion leads from one state to the next: a stamp or a position is wrong.
bool is_jump(const UavState& from, const UavState& to) {
  const double way = (to.motion.p - from.motion.p).norm();
  const double speed = std::max(from.motion.v.norm(), to.motion.v.norm());
  return way > kJump && way > (2.0 * speed + kJumpSpeed) * (to.at - from.at).seconds();
}

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
  } else if (is_jump(newest_, state)) {
    CubicPiece stays{state.at - newest_.at, PowerCubic::Zero()};
    stays.coefficients.col(3) = newest_.motion.p;
    truth_.append(stays);
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
