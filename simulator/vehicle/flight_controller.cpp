#include "simulator/vehicle/flight_controller.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

Vec3 at_most(const Vec3& x, double length) {
  const double norm = x.norm();
  return norm > length ? Vec3(x * (length / norm)) : x;
}

}  // namespace

Vec3 FlightController::commanded_acceleration(const FlightCommand& command, const FlightEstimate& estimate, double dt) {
  const MotionSample& m = command.motion;
  const Vec3 velocity = at_most(m.v + gains_.position_p * (m.p - estimate.p), gains_.speed_max);
  const Vec3 error = velocity - estimate.v;
  const Vec3 level(estimate.a.x(), estimate.a.y(), 0.0);
  const Vec3 wanted = m.a + gains_.lead_s * m.j + gains_.drag_per_s * m.v + gains_.velocity_p * error + integral_ -
                      gains_.velocity_d * level;
  const Vec3 thrust = thrust_for(wanted);
  Vec3 had = thrust / body_.mass_kg - Vec3(0.0, 0.0, kGravity);
  if ((had - wanted).norm() < 1e-6) integral_ += gains_.velocity_i * error * dt;
  return had;
}

Vec3 FlightController::thrust_for(const Vec3& acceleration) const {
  const double most = 4.0 * body_.max_thrust();
  Vec3 thrust = body_.mass_kg * (acceleration + Vec3(0.0, 0.0, kGravity));
  thrust.z() = std::clamp(thrust.z(), body_.least_thrust * most, most);
  const double sideways =
      std::min(thrust.z() * std::tan(gains_.tilt_max), std::sqrt(std::max(0.0, most * most - thrust.z() * thrust.z())));
  thrust.head<2>() = at_most(Vec3(thrust.x(), thrust.y(), 0.0), sideways).head<2>();
  return thrust;
}

Vec3 FlightController::rates_for(const Vec3& thrust, const FlightCommand& command,
                                 const FlightEstimate& estimate) const {
  const Vec3 up = estimate.q * Vec3::UnitZ();
  const Eigen::Quaterniond tilt = smallest_rotation(up, thrust);
  const Eigen::Quaterniond tilted = tilt * estimate.q;
  // The remaining heading error is about the thrust's axis.
  const Vec3 z = thrust.normalized();
  const Vec3 ahead(std::cos(command.yaw), std::sin(command.yaw), 0.0);
  const Vec3 wanted_x = (ahead - ahead.dot(z) * z).normalized();
  const Vec3 x = tilted * Vec3::UnitX();
  const double heading = std::atan2(x.cross(wanted_x).dot(z), x.dot(wanted_x));
  const Vec3 tilt_B = estimate.q.conjugate() * Vec3(tilt.vec() * (tilt.w() < 0.0 ? -2.0 : 2.0));
  Vec3 rates = gains_.attitude_p * tilt_B;
  rates.z() += gains_.yaw_p * heading + command.yaw_rate;
  rates.head<2>() = at_most(Vec3(rates.x(), rates.y(), 0.0), gains_.rate_max).head<2>();
  rates.z() = std::clamp(rates.z(), -gains_.yaw_rate_max, gains_.yaw_rate_max);
  return rates;
}

Rotors FlightController::update(const FlightCommand& command, const FlightEstimate& estimate, double dt) {
  const Vec3 thrust = body_.mass_kg * (commanded_acceleration(command, estimate, dt) + Vec3(0.0, 0.0, kGravity));
  const Vec3 rates = rates_for(thrust, command, estimate);
  Wrench wrench;
  wrench.thrust = std::max(0.0, thrust.dot(estimate.q * Vec3::UnitZ()));
  const Vec3 momentum = body_.inertia.cwiseProduct(estimate.w);
  wrench.torque = body_.inertia.cwiseProduct(gains_.rate_p * (rates - estimate.w)) + estimate.w.cross(momentum);
  return allocate(body_, wrench);
}

}  // namespace tern
