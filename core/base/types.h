// Tern's names for Eigen types, and the conversion from signed counts to the unsigned subscripts of std containers.
// Inline functions of core's headers are written by coordinate. A source that reads an Eigen expression compiles it
// anew, even if it does not call the function.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace tern {

using Vec3 = Eigen::Vector3d;
/// Points as a 3×n matrix, one point per column.
using Points = Eigen::Matrix3Xd;
/// An axis-aligned box in W, m. A default-constructed box is empty.
using Box = Eigen::AlignedBox3d;

/// Returns the box with centre c and half-extents h.
inline Box box_around(const Vec3& c, const Vec3& h) {
  return {Vec3(c.x() - h.x(), c.y() - h.y(), c.z() - h.z()), Vec3(c.x() + h.x(), c.y() + h.y(), c.z() + h.z())};
}

/// Returns the box enlarged by g (m per axis, each ≥ 0) on both sides of each axis.
inline Box grown(const Box& b, const Vec3& g) {
  const Vec3 &low = b.min(), &high = b.max();
  return {Vec3(low.x() - g.x(), low.y() - g.y(), low.z() - g.z()),
          Vec3(high.x() + g.x(), high.y() + g.y(), high.z() + g.z())};
}

/// Returns `i` as a subscript of a std container: `candidates[idx(interval)]`, `counts[idx(outcome)]`.
/// @pre i ≥ 0; this is not checked
template <class I>
requires std::integral<I> || std::is_enum_v<I>
[[nodiscard]] constexpr std::size_t idx(I i) { return static_cast<std::size_t>(i); }

}  // namespace tern
