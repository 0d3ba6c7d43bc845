#include "simulator/referee/believed_arrival.h"

#include "simulator/referee/flight_measures.h"

namespace tern {
namespace {

bool is_at(const Vec3& goal, const MotionSample& motion) { return (motion.p - goal).norm() <= kGoalRadius; }
bool rests_at(const Vec3& goal, const MotionSample& motion) {
  return is_at(goal, motion) && motion.v.norm() < kRestSpeed;
}

}  // namespace

bool BelievedArrival::update(UTime now, const Vec3& goal, const MotionSample& setpoint, const MotionSample& believed,
                             double to_come) {
  if (!rests_at(goal, setpoint)) {
    reset();
    return false;
  }
  if (!since_ && rests_at(goal, believed)) since_ = settled_since_ = now;
  if (!since_) return false;
  if (to_come > kLarge) settled_since_ = now;
  return is_at(goal, believed) && (now - settled_since_ >= kWait || now - *since_ >= kLongestWait);
}

}  // namespace tern
