#include "estimator/filter/continuity.h"

#include <cmath>
#include <numbers>

#include "estimator/filter/rotation.h"

namespace tern {

OdometryOffset after_correction(const OdometryOffset& T_WO, const PoseInW& before, const PoseInW& after,
                                double max_step, double max_turn) {
  const double turn = twist_about_z(after.R * before.R.transpose());
  if ((after.p - before.p).norm() <= max_step && std::abs(turn) <= max_turn) return T_WO;
  const PoseInO in_O = T_WO.to_O(before);
  OdometryOffset out{Vec3::Zero(), std::remainder(T_WO.yaw + turn, 2.0 * std::numbers::pi), T_WO.epoch + 1};
  out.translation = after.p - out.rotation() * in_O.p;
  return out;
}

}  // namespace tern
