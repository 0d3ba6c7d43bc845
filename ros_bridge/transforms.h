// Poses of frames over time, as ROS publishes them on /tf and /tf_static.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "ros_messages/types.h"

namespace tern::ros {

/// The pose of a frame F in a frame P: x_P = R_PF·x_F + p_PF.
struct RigidTransform {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< R_PF, a unit quaternion
  Vec3 p = Vec3::Zero();                                  ///< p_PF, m

  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return q * x + p; }
  /// Returns x ↦ (*this)(inner(x)).
  [[nodiscard]] RigidTransform after(const RigidTransform& inner) const { return {q * inner.q, (*this)(inner.p)}; }
  [[nodiscard]] RigidTransform inverse() const { return {q.conjugate(), -(q.conjugate() * p)}; }
};

/// Reads a position and an orientation.
/// @return an Error unless all numbers are finite, coordinates within kMaxCoordinate, and the quaternion has length 1
///   (to 1 %: single precision and hand-written values)
Result<RigidTransform> read_pose(const ros::Vector3& position, const ros::Quaternion& orientation);
Result<RigidTransform> read_pose(const ros::Pose& pose);

/// Remembers each frame's pose in its parent for kKept, and interpolates: positions linearly, rotations by slerp. It
/// never extrapolates. Memory is bounded, whatever is received.
class TransformBuffer {
 public:
  static constexpr Duration kKept{10'000'000};
  /// A pose may have a stamp this far ahead. SLAM systems date map → odom into the future: so it is known at the
  /// present time.
  static constexpr Duration kAhead{2'000'000};
  static constexpr std::size_t kMaxFrames = 500, kMaxSamples = 2'000, kMaxNameBytes = 200;
  static constexpr int kMaxDepth = 50;

  /// Adds a pose. A frame that gets another parent forgets its poses in the former one.
  /// @return an Error for a frame without name or in itself, for a pose that read_pose refuses, and for more than
  ///   kMaxFrames. Also for a pose older than kKept or more than kAhead ahead
  Result<void> add(const ros::TransformStamped& transform, bool is_static, UTime now);

  /// Returns the pose of `frame` in `base` at a time, or, for nullopt, by each frame's newest pose.
  /// @return an Error that names the frame that is missing, or whose poses do not reach that time. It may come later
  Result<RigidTransform> find(const std::string& base, const std::string& frame, std::optional<UTime> at) const;

 private:
  struct Sample {
    UTime at;
    RigidTransform pose;
  };
  struct Frame {
    std::string parent;
    bool is_static = false;
    std::deque<Sample> samples;  ///< in the order of time, ≥ 1
  };
  [[nodiscard]] Result<RigidTransform> to_root(std::string frame, const std::string& stop, std::optional<UTime> at,
                                               std::string& root) const;

  std::map<std::string, Frame, std::less<>> frames_;  ///< by name
};

}  // namespace tern::ros
