// The covariance of a visual-inertial filter, propagated along a way before it is flown.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "planner/semantics/drift.h"
#include "planner/semantics/information_map.h"

namespace tern {

/// The covariance of the errors (position, velocity, attitude, accelerometer bias, gyroscope bias).
///
///     δṗ = δv,   δv̇ = −[f]×θ − R δb_a + n_a,   θ̇ = −R δb_g + n_g,   R = Exp(θ) R̂
/// f = a − g is the specific force in W. A frame pair measures two things:
///  - the velocity of the body, h(x) = Rᵀv, with H = [0 1 [v]× 0 0] in W;
///  - the rotation against the gyroscope, which tells b_g.
///
/// Tracks live longer than a pair, so the deviations of a pair are multiplied by kTrackGain.
class Belief15 {
 public:
  using Covariance = Eigen::Matrix<double, 15, 15>;

  /// At rest before take-off: the position is known, and tilt and accelerometer bias are one unknown,
  /// θ_y = b_x/g and θ_x = −b_y/g.
  explicit Belief15(const InertialNoise& noise = kFlightNoise);
  /// Of this covariance.
  Belief15(const Covariance& P, const InertialNoise& noise) : P_(P), noise_(noise) {}

  /// Moves on by h seconds with this heading (rad) and acceleration (W).
  void move(double h_s, double heading, const Vec3& a);
  /// Uses what is seen during h seconds of frames that are frame_s apart.
  void see(double h_s, const Sight& sight, double frame_s, const Vec3& v);

  /// σ of the position, √tr Σ, m.
  [[nodiscard]] double position_sigma() const;
  [[nodiscard]] const Covariance& covariance() const { return P_; }

 private:
  template <int Rows>
  void update(const Eigen::Matrix<double, Rows, 15>& H, double variance);

  Covariance P_ = Covariance::Zero();
  InertialNoise noise_;
};

/// σ of the position as the filter is expected to state it, m.
struct ForetoldError {
  double at_goal = 0.0, at_worst = 0.0;
};

/// Foretells the error of a flight along a path, at this speed, from rest to rest, looking along the flight. Takes
/// about 15 µs per kBeliefStep.
/// @pre path has at least one point, speed > 0
ForetoldError foretell_error(const std::vector<Vec3>& path, double speed, const InformationMap& information);

inline constexpr double kBeliefStep = 0.1;          ///< s
inline constexpr double kBeliefAcceleration = 5.0;  ///< of start and stop, m/s²

}  // namespace tern
