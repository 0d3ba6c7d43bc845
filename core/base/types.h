// Eigen's shapes by the names that Tern uses, and the step from its signed counts to std's unsigned ones.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace tern {

using Vec3 = Eigen::Vector3d;
/// 3×n, a point per column.
using Points = Eigen::Matrix3Xd;
/// Axis-aligned box in W, metres. Default-constructed: empty.
using Box = Eigen::AlignedBox3d;

/// The box of centre c and half-extents h.
inline Box box_around(const Vec3& c, const Vec3& h) { return {c - h, c + h}; }

/// The box grown by g (per axis, metres, each ≥ 0) on every side.
inline Box grown(const Box& b, const Vec3& g) { return {b.min() - g, b.max() + g}; }

/// `i` as a subscript of a std container: `candidates[idx(interval)]`, `counts[idx(outcome)]`.
/// @pre i ≥ 0. Nothing is checked: a subscript is not, either.
template <class I>
requires std::integral<I> || std::is_enum_v<I>
[[nodiscard]] constexpr std::size_t idx(I i) { return static_cast<std::size_t>(i); }

}  // namespace tern
