// The fields of a unit quaternion, as several messages have them.
#pragma once

#include <cmath>

#include "core/base/types.h"

namespace tern::wire {

inline constexpr double kQuaternionTolerance = 1e-3;  ///< of the quaternion's length

/// Reads or writes q_w, q_x, q_y and q_z; io is a FieldReader or a FieldWriter.
void quaternion_fields(auto& io, auto& m, auto& q) {
  constexpr double kMaxPart = 1.0 + kQuaternionTolerance;
  io.number("q_w", m.q_w, q[0], -kMaxPart, kMaxPart);
  io.number("q_x", m.q_x, q[1], -kMaxPart, kMaxPart);
  io.number("q_y", m.q_y, q[2], -kMaxPart, kMaxPart);
  io.number("q_z", m.q_z, q[3], -kMaxPart, kMaxPart);
}

inline bool is_unit(const Eigen::Vector4d& q) { return std::abs(q.norm() - 1.0) <= kQuaternionTolerance; }

}  // namespace tern::wire
