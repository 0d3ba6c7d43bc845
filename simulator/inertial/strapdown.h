// Strapdown integration: how an inertial state moves under constant body rates and specific force.
#pragma once

#include "core/base/types.h"

namespace tern {

using Mat3 = Eigen::Matrix3d;

/// Pose and velocity of the body B (forward, left, up).
struct InertialState {
  Mat3 R = Mat3::Identity();  ///< B to W
  Vec3 p = Vec3::Zero();      ///< W, m
  Vec3 v = Vec3::Zero();      ///< W, m/s
};

/// The measurement of an inertial sensor over one sample interval, in B: means that integrate to the motion.
struct InertialSample {
  Vec3 rate = Vec3::Zero();   ///< body rates ω, rad/s
  Vec3 force = Vec3::Zero();  ///< specific force f, m/s²; (0, 0, g) at rest
};

/// Returns the rotation by the vector φ (rad): Exp([φ]×).
Mat3 rotation_exp(const Vec3& phi);
/// Returns φ with rotation_exp(φ) = R and |φ| ≤ π. @pre R is a rotation by less than π
Vec3 rotation_log(const Mat3& R);

/// Moves a state over h seconds by a constant sample, with φ = ωh and gravity g = (0, 0, −kGravity):
///
///     p += v h + g h²/2 + R Γ₂(φ) f h²,   v += g h + R Γ₁(φ) f h,   R ← R Exp(φ)
///     Γ₁ = I + (1 − cos θ)/θ² [φ]× + (θ − sin θ)/θ³ [φ]×²,
///     Γ₂ = I/2 + (θ − sin θ)/θ³ [φ]× + (θ²/2 + cos θ − 1)/θ⁴ [φ]×²,   θ = |φ|
///
/// These are the exact integrals. Source: M. Bloesch et al., "State estimation for legged robots", RSS 2012.
InertialState strapdown(const InertialState& from, const InertialSample& sample, double h_s);

/// Returns the sample with which strapdown() leads to the attitude and velocity of `to`. (Force and rates of one
/// instant would be wrong where the jerk jumps, and the errors would add up.) The position of strapdown() then differs
/// from that of `to` by at most h³/12 times the largest derivative of the force.
/// @pre h_s > 0, and the rotation between both states is less than π
InertialSample sample_between(const InertialState& from, const InertialState& to, double h_s);

}  // namespace tern
