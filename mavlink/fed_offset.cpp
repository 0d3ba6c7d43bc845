#include "mavlink/fed_offset.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tern::mavlink {
namespace {

/// Step of the loops, s: that of a Copter at 400 Hz.
constexpr double kStep = 0.0025;

/// Share by which a first-order low pass nears its input within dt.
double nearing(double dt, double corner_hz) {
  return corner_hz > 0.0 ? dt / (dt + 1.0 / (2.0 * std::numbers::pi * corner_hz)) : 1.0;
}

}  // namespace

const MotionSample& FedOffset::step(const Vec3& acceleration, const CopterLoops& loops, double dt) {
  const int steps = std::max(1, static_cast<int>(std::ceil(dt / kStep)));
  const double h = dt / steps;
  const Vec3 wanted(acceleration.x(), acceleration.y(), 0.0);
  MotionSample& e = offset_;
  for (int k = 0; k < steps; ++k) {
    const Vec3 before = error_;
    error_ += nearing(h, loops.error_hz) * (e.v + loops.position_p * e.p - error_);
    derivative_ += nearing(h, loops.derivative_hz) * ((error_ - before) / h - derivative_);
    integral_ += h * loops.velocity_i * error_;
    e.a = wanted - loops.velocity_p * error_ - integral_ - loops.velocity_d * derivative_;
    e.p += h * e.v + 0.5 * h * h * e.a;
    e.v += h * e.a;
  }
  if (!(e.p.norm() <= kLargest)) reset();
  return e;
}

}  // namespace tern::mavlink
