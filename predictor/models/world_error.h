// How wrong the position of a thing that is known in W may be, for a vehicle that estimates its own pose.
#pragma once

#include <optional>
#include <vector>

#include "core/world/inertial.h"
#include "core/world/pose_error.h"
#include "core/world/track.h"

namespace tern {

/// The PoseError of each time follows from ODOMETRY and UAV_STATE. Its part `apart` is d plus the drift of a stale
/// estimate. d is the distance of the position that the vehicle flies by (UAV_STATE) from the estimate in W, while a
/// correction is still being followed.
///
/// An estimate that is older than kFresh, because the estimator is lost or has ended, says nothing about the drift
/// since then. d stays, and kDriftSpeed is added for each further second, up to kMostDrift. A faster drift is not
/// covered.
class WorldError {
 public:
  static constexpr Duration kFresh{300'000};
  static constexpr double kDriftSpeed = 0.5;  ///< m/s
  static constexpr double kMostDrift = 5.0;   ///< m

  /// Takes an ODOMETRY. One without a valid pose changes nothing.
  void add(const Odometry& odometry);
  /// Takes the position by which the vehicle flies, W, m.
  void add_vehicle(const Vec3& p, UTime at);
  /// Whether there was a valid ODOMETRY.
  [[nodiscard]] bool is_known() const { return odometry_.has_value(); }
  /// Whether the newest valid ODOMETRY is older than kFresh.
  [[nodiscard]] bool is_stale(UTime at) const { return odometry_ && odometry_->at + kFresh < at; }
  /// Returns the error at time `at`, without header and set. @pre is_known()
  [[nodiscard]] PoseError pose_error(UTime at) const;

 private:
  [[nodiscard]] double drift(UTime at) const;  // m

  std::optional<Odometry> odometry_;
  Vec3 position_ = Vec3::Zero(), velocity_ = Vec3::Zero();  ///< the estimate's position (m) and velocity (m/s) in W
  double apart_ = 0.0;                                      ///< d, m
};

/// Adds to α of each track the margin at its centre at time `at`.
void widen(std::vector<Track>& tracks, const PoseError& error, UTime at);

}  // namespace tern
