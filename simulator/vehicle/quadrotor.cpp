#include "simulator/vehicle/quadrotor.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tern {
namespace {

/// Signs of each rotor's position and sense of rotation.
constexpr Rotors kForward{1.0, -1.0, -1.0, 1.0}, kLeft{1.0, 1.0, -1.0, -1.0}, kSense{1.0, -1.0, 1.0, -1.0};

/// Largest raise of thrust for the sake of torque, as a share of the difference to the hover thrust: ArduPilot's
/// ATC_THR_MIX_MAX. PX4 raises none (MC_AIRMODE 0). Without a bound, a fast turn at little thrust lifts the vehicle.
constexpr double kLift = 0.5;

struct Derivative {
  Vec3 p, v, w;
  Eigen::Vector4d q;
  Rotors thrust;
};

Eigen::Vector4d rate_of(const Eigen::Quaterniond& q, const Vec3& w) {
  return 0.5 * (q * Eigen::Quaterniond(0.0, w.x(), w.y(), w.z())).coeffs();
}

Derivative derivative(const QuadrotorSpec& spec, const QuadrotorState& s, const Rotors& command, const Vec3& wind) {
  Derivative d;
  d.p = s.v;
  d.v = acceleration(spec, s, wind);
  d.q = rate_of(s.q, s.w);
  const Vec3 torque = wrench_of(spec, s.thrust).torque;
  d.w = (torque - s.w.cross(spec.inertia.cwiseProduct(s.w))).cwiseQuotient(spec.inertia);
  for (std::size_t k = 0; k < 4; ++k) d.thrust[k] = (command[k] - s.thrust[k]) / spec.motor_lag_s;
  return d;
}

QuadrotorState moved(const QuadrotorState& s, const Derivative& d, double dt) {
  QuadrotorState next = s;
  next.p += d.p * dt;
  next.v += d.v * dt;
  next.w += d.w * dt;
  next.q.coeffs() += d.q * dt;
  for (std::size_t k = 0; k < 4; ++k) next.thrust[k] += d.thrust[k] * dt;
  return next;
}

Derivative mean(const Derivative& a, const Derivative& b, const Derivative& c, const Derivative& d) {
  Derivative m;
  m.p = (a.p + 2.0 * (b.p + c.p) + d.p) / 6.0;
  m.v = (a.v + 2.0 * (b.v + c.v) + d.v) / 6.0;
  m.w = (a.w + 2.0 * (b.w + c.w) + d.w) / 6.0;
  m.q = (a.q + 2.0 * (b.q + c.q) + d.q) / 6.0;
  for (std::size_t k = 0; k < 4; ++k) {
    m.thrust[k] = (a.thrust[k] + 2.0 * (b.thrust[k] + c.thrust[k]) + d.thrust[k]) / 6.0;
  }
  return m;
}

Eigen::Quaterniond level(double yaw) { return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec3::UnitZ())); }

double yaw_of(const Eigen::Quaterniond& q) {
  const Vec3 x = q * Vec3::UnitX();
  return std::atan2(x.y(), x.x());
}

void stand(QuadrotorState& s, double ground_z) {
  s.p.z() = ground_z;
  s.v.setZero();
  s.w.setZero();
  s.q = level(yaw_of(s.q));
  s.on_ground = true;
}

Rotors sum_of(double thrust, const Rotors& torque) {
  Rotors each{};
  for (std::size_t k = 0; k < 4; ++k) each[k] = thrust / 4.0 + torque[k];
  return each;
}

/// The largest share in [0, 1] of `part` that keeps base + share·part within [low, high].
double share_within(const Rotors& base, const Rotors& part, double low, double high) {
  double share = 1.0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (part[k] > 0.0) share = std::min(share, (high - base[k]) / part[k]);
    if (part[k] < 0.0) share = std::min(share, (low - base[k]) / part[k]);
  }
  return std::clamp(share, 0.0, 1.0);
}

/// The thrust, raised to make room for a torque, within the bound of kLift.
double lifted(const QuadrotorSpec& spec, double thrust, double enough) {
  const double hover = spec.mass_kg * kGravity;
  return std::max(thrust, std::min(enough, thrust + kLift * (hover - thrust)));
}

}  // namespace

QuadrotorSpec quadrotor_spec(QuadrotorClass kind) {
  QuadrotorSpec spec;
  if (kind == QuadrotorClass::Camera) return spec;
  spec.mass_kg = 0.752;
  spec.inertia = Vec3(0.0025, 0.0021, 0.0043);
  spec.arm_m = 0.088;
  spec.thrust_to_weight = 4.0;
  spec.least_thrust = 0.02;
  spec.motor_lag_s = 0.033;
  spec.torque_per_thrust_m = 0.022;
  spec.drag_per_s = 0.46;
  spec.drag_per_m = 0.01;
  return spec;
}

QuadrotorState hovering(const QuadrotorSpec& spec, const Vec3& p, double yaw) {
  QuadrotorState state;
  state.p = p;
  state.q = level(yaw);
  state.thrust.fill(spec.mass_kg * kGravity / 4.0);
  return state;
}

QuadrotorState standing(const QuadrotorSpec& spec, const Vec3& p, double yaw) {
  QuadrotorState state = hovering(spec, p, yaw);
  state.thrust.fill(spec.least_thrust * spec.max_thrust());
  state.on_ground = true;
  return state;
}

Eigen::Quaterniond smallest_rotation(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond q;
  if (cosine < -1.0 + 1e-12) {
    q.w() = 0.0;
    q.vec() = a.unitOrthogonal();
    return q;
  }
  const double s = std::sqrt((1.0 + cosine) * 2.0);
  q.vec() = a.cross(b) * (1.0 / s);
  q.w() = s * 0.5;
  return q;
}

Vec3 acceleration(const QuadrotorSpec& spec, const QuadrotorState& s, const Vec3& wind) {
  const double thrust = std::accumulate(s.thrust.begin(), s.thrust.end(), 0.0);
  const Vec3 air_B = s.q.conjugate() * (s.v - wind);
  const Vec3 linear(spec.drag_per_s, spec.drag_per_s, spec.drag_up_per_s);
  const Vec3 drag_B = -(linear + Vec3::Constant(spec.drag_per_m * air_B.norm())).cwiseProduct(air_B);
  return s.q * (Vec3(0.0, 0.0, thrust / spec.mass_kg) + drag_B) - Vec3(0.0, 0.0, kGravity);
}

Wrench wrench_of(const QuadrotorSpec& spec, const Rotors& thrust) {
  Wrench wrench;
  for (std::size_t k = 0; k < 4; ++k) {
    wrench.thrust += thrust[k];
    wrench.torque +=
        thrust[k] * Vec3(spec.arm_m * kLeft[k], -spec.arm_m * kForward[k], spec.torque_per_thrust_m * kSense[k]);
  }
  return wrench;
}

Rotors allocate(const QuadrotorSpec& spec, const Wrench& wanted) {
  const double high = spec.max_thrust(), low = spec.least_thrust * high;
  Rotors tilt{}, turn{};
  for (std::size_t k = 0; k < 4; ++k) {
    tilt[k] = (wanted.torque.x() * kLeft[k] - wanted.torque.y() * kForward[k]) / (4.0 * spec.arm_m);
    turn[k] = wanted.torque.z() * kSense[k] / (4.0 * spec.torque_per_thrust_m);
  }
  Rotors all = sum_of(wanted.thrust, tilt);
  for (std::size_t k = 0; k < 4; ++k) all[k] += turn[k];
  if (std::all_of(all.begin(), all.end(), [&](double t) { return t >= low && t <= high; })) return all;
  const auto [least, most] = std::minmax_element(tilt.begin(), tilt.end());
  const double share = std::min(1.0, (high - low) / std::max(*most - *least, 1e-12));
  const double thrust =
      std::clamp(lifted(spec, wanted.thrust, 4.0 * (low - share * *least)), 4.0 * low, 4.0 * (high - share * *most));
  Rotors each = sum_of(thrust, Rotors{});
  const double tilted = share_within(each, tilt, low, high);
  for (std::size_t k = 0; k < 4; ++k) each[k] += tilted * tilt[k];
  const double turned = share_within(each, turn, low, high);
  for (std::size_t k = 0; k < 4; ++k) each[k] = std::clamp(each[k] + turned * turn[k], low, high);
  return each;
}

QuadrotorState step(const QuadrotorSpec& spec, const QuadrotorState& s, const Rotors& command, const Vec3& wind,
                    double ground_z, double dt) {
  const Derivative a = derivative(spec, s, command, wind);
  const Derivative b = derivative(spec, moved(s, a, dt / 2.0), command, wind);
  const Derivative c = derivative(spec, moved(s, b, dt / 2.0), command, wind);
  const Derivative d = derivative(spec, moved(s, c, dt), command, wind);
  QuadrotorState next = moved(s, mean(a, b, c, d), dt);
  next.q.normalize();
  next.on_ground = false;
  if (next.p.z() <= ground_z && next.v.z() <= 0.0) {
    if (s.on_ground) next.p = s.p;  // it does not slide
    stand(next, ground_z);
  }
  return next;
}

}  // namespace tern
