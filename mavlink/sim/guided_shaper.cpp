#include "mavlink/sim/guided_shaper.h"

#include <algorithm>
#include <cmath>

namespace tern::mavlink {
namespace {

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;

template <int N>
Vector<N> limited(const Vector<N>& v, double length) {
  const double norm = v.norm();
  return norm > length ? Vector<N>(v * (length / norm)) : v;
}

/// The speed that closes a distance: proportional to it, and farther away as fast as this deceleration can stop.
double closing_speed(double distance, double gain, double deceleration, double dt) {
  const double linear = deceleration / (gain * gain);
  const double speed = distance <= linear ? gain * distance : std::sqrt(2.0 * deceleration * (distance - 0.5 * linear));
  return std::min(speed, distance / dt);
}

/// A correction is limited to `most`. Braking has priority over turning, turning over going faster.
template <int N>
Vector<N> limited_correction(const Vector<N>& v, const Vector<N>& correction, double most) {
  if (v.isZero(0.0)) return limited<N>(correction, most);
  const Vector<N> ahead = v.normalized(), a = limited<N>(correction, 2.0 * most);
  const double along = a.dot(ahead);
  const Vector<N> across = a - along * ahead;
  const auto rest = [&](double used) { return std::sqrt(std::max(most * most - used * used, 0.0)); };
  if (along > 0.0) {
    const Vector<N> turning = limited<N>(across, most);
    return turning + std::min(along, rest(turning.norm())) * ahead;
  }
  const double braking = std::max(along, -most);
  return limited<N>(across, rest(braking)) + braking * ahead;
}

template <int N>
Vector<N> shaped(const Vector<N>& error, const Vector<N>& v_setpoint, const Vector<N>& a_setpoint, const Vector<N>& v,
                 const Vector<N>& a, const ShapingLimits& limits, double dt) {
  const double gain = limits.jerk / limits.acceleration, distance = error.norm();
  Vector<N> correction = Vector<N>::Zero();
  if (distance > 0.0) {
    const Vector<N> towards = error / distance;
    const double closes = (v - v_setpoint).dot(towards);
    double speed = closing_speed(distance, gain, limits.acceleration, dt);
    if (speed * closes > 0.0) {
      const bool is_near = distance <= limits.acceleration / (gain * gain);
      speed -= (is_near ? gain : limits.acceleration / speed) * closes / gain;
    }
    correction = speed * towards;
  }
  const Vector<N> wanted =
      a_setpoint + limited_correction<N>(v, gain * (v_setpoint + correction - v), limits.acceleration);
  return a + limited<N>(wanted - a, limits.jerk * dt);
}

}  // namespace

const MotionSample& GuidedShaper::step(const MotionSample& setpoint, const ShapingLimits& level,
                                       const ShapingLimits& up, double dt) {
  MotionSample& d = desired_;
  d.p += d.v * dt + 0.5 * d.a * dt * dt;
  d.v += d.a * dt;
  d.j = Vec3::Zero();
  const Vec3 error = setpoint.p - d.p;
  const auto part = [&]<int N>(int first, const ShapingLimits& limits) {
    const auto of = [&](const Vec3& v) { return Vector<N>(v.segment<N>(first)); };
    d.a.segment<N>(first) = shaped<N>(of(error), of(setpoint.v), of(setpoint.a), of(d.v), of(d.a), limits, dt);
  };
  part.operator()<2>(0, level);
  part.operator()<1>(2, up);
  return d;
}

}  // namespace tern::mavlink
