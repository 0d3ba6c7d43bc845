#include "simulator/referee/believed_arrival.h"

#include "simulator/referee/flight_measures.h"

namespace tern {
namespace {

bool is_at(const Vec3& goal, const MotionSample& motion) { return (motion.p - goal).norm() <= kGoalRadius; }
bool rests_at(const Vec3& goal, const MotionSample& motion) {
  return is_at(goal, motion) && motion.v.norm() < kRestSpeed;
}

}  // namespace

bool BelievedArrival::update(UTime now, const Vec3& goal, const MotionSample& setpoint, const MotionSample& believed) {
  if (!rests_at(goal, setpoint)) {
    reset();
    return false;
  }
  if (!since_ && rests_at(goal, believed)) since_ = now;
  return since_ && now - *since_ >= kWait && is_at(goal, believed);
}

}  // namespace tern
