// How wrong the position of a thing that is known in W may be, for a vehicle that estimates its own pose.
#pragma once

#include <optional>
#include <vector>

#include "core/world/inertial.h"
#include "core/world/track.h"

namespace tern {

/// A vehicle flies relative to W as it believes W to be. With errors e_p of position and θ of attitude, a
/// thing known in W at x is off by e_p + θ × (x − p̂):
///
///     Σ(x) = J Σ_pose Jᵀ,   J = [1, −[x − p̂]×],   margin(x) = k √λ_max(Σ(x)) + d,   k = 3.368
///
/// k is the 99 % quantile of the length of a normal vector in three dimensions over the standard deviation of each
/// axis. d is the distance of the position that the vehicle flies by (UAV_STATE) from the estimate in W, while a
/// correction is still being followed. The margin is rounded up to kStep, so that static obstacles change seldom.
///
/// An estimate that is older than kFresh, because the estimator is lost or has ended, says nothing about the drift
/// since then. d stays, and widen() adds kDriftSpeed for each further second, up to kMostDrift. A faster drift is not
/// covered.
class WorldError {
 public:
  static constexpr double kQuantile = 3.368;   ///< √χ²(3, 0.99)
  static constexpr double kConfidence = 0.99;  ///< of the margin
  static constexpr double kStep = 0.05;        ///< m
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
  /// The margin of a fresh estimate at x (W, m), per axis; 0 while nothing is known.
  [[nodiscard]] double margin(const Vec3& x) const;
  /// Adds to α of each track the margin at its centre at time `at`, and the drift of a stale estimate.
  void widen(std::vector<Track>& tracks, UTime at) const;

 private:
  [[nodiscard]] double drift(UTime at) const;  // m

  std::optional<Odometry> odometry_;
  Vec3 position_ = Vec3::Zero(), velocity_ = Vec3::Zero();  ///< the estimate's position (m) and velocity (m/s) in W
  double apart_ = 0.0;                                      ///< d, m
};

}  // namespace tern
