// The frames of a vehicle that estimates its own pose, as types: mixing them does not compile.
// The frame W is the world; goals, maps, regions, declared motions, tags and GNSS are given there. The frame O is the
// odometry frame of one flight. By default a correction moves the vehicle in O by at most 1 cm. A larger one
// changes the transform T_WO from O to W: a position and a yaw, since both frames have z up.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/types.h"

namespace tern {

/// Tags of the frames.
struct FrameO;
struct FrameW;

/// A position in a frame, m.
template <class Frame>
struct PointIn {
  Vec3 xyz = Vec3::Zero();
};

/// A free vector in a frame, for example a velocity. A change of frame rotates it and does not move it.
template <class Frame>
struct VectorIn {
  Vec3 xyz = Vec3::Zero();
};

/// A pose of the body B in a frame: the columns of R are B's axes, p is B's position, m.
template <class Frame>
struct PoseIn {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3 p = Vec3::Zero();
};

using PointInO = PointIn<FrameO>;
using PointInW = PointIn<FrameW>;
using VectorInO = VectorIn<FrameO>;
using VectorInW = VectorIn<FrameW>;
using PoseInO = PoseIn<FrameO>;
using PoseInW = PoseIn<FrameW>;

/// T_WO: x_W = Rz(yaw) x_O + translation. The epoch counts its changes, so two values of one flight with one epoch are
/// equal.
struct OdometryOffset {
  Vec3 translation = Vec3::Zero();  ///< the origin of O in W, m
  double yaw = 0.0;                 ///< rad, (−π, π]
  std::int64_t epoch = 0;           ///< 0 at the start of a flight

  /// Returns Rz(yaw).
  [[nodiscard]] Eigen::Matrix3d rotation() const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    Eigen::Matrix3d R;
    R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
    return R;
  }
  [[nodiscard]] PointInW to_W(const PointInO& x) const { return {rotation() * x.xyz + translation}; }
  [[nodiscard]] VectorInW to_W(const VectorInO& v) const { return {rotation() * v.xyz}; }
  [[nodiscard]] PoseInW to_W(const PoseInO& T) const { return {rotation() * T.R, rotation() * T.p + translation}; }
  [[nodiscard]] PointInO to_O(const PointInW& x) const { return {rotation().transpose() * (x.xyz - translation)}; }
  [[nodiscard]] VectorInO to_O(const VectorInW& v) const { return {rotation().transpose() * v.xyz}; }
  [[nodiscard]] PoseInO to_O(const PoseInW& T) const {
    return {rotation().transpose() * T.R, rotation().transpose() * (T.p - translation)};
  }
};

}  // namespace tern
