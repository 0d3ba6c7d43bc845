#include "mavlink/sim/guided_loops.h"

#include <numbers>

namespace tern::mavlink {
namespace {

double nearing(double dt, double corner_hz) { return dt / (dt + 1.0 / (2.0 * std::numbers::pi * corner_hz)); }

Vec3 level(const Vec3& v) { return {v.x(), v.y(), 0.0}; }

}  // namespace

MotionSample GuidedLoops::step(const MotionSample& desired, const MotionSample& estimate, const CopterLoops& loops,
                               double input_tc, double dt) {
  const Vec3 error = level(desired.v + loops.position_p * (desired.p - estimate.p) - estimate.v);
  if (!started_) error_ = error;
  started_ = true;
  const Vec3 before = error_;
  error_ += nearing(dt, loops.error_hz) * (error - error_);
  derivative_ += nearing(dt, loops.derivative_hz) * ((error_ - before) / dt - derivative_);
  integral_ += dt * loops.velocity_i * error_;
  const Vec3 wanted = level(desired.a) + loops.velocity_p * error_ + integral_ + loops.velocity_d * derivative_;
  const double rate = 1.0 / input_tc;
  tilting_ += dt * rate * (rate * (wanted - tilted_) - 2.0 * tilting_);
  tilted_ += dt * tilting_;
  MotionSample command = desired;
  command.p.head<2>() = estimate.p.head<2>();
  command.v.head<2>() = estimate.v.head<2>();
  command.a.head<2>() = tilted_.head<2>();
  return command;
}

}  // namespace tern::mavlink
