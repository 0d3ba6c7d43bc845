// How far a vehicle that estimates its pose states to be off, and how a flight ends that rests on this alone.
#pragma once

#include <array>
#include <string_view>

#include "core/base/types.h"

namespace tern {

/// χ² of three degrees of freedom, 99 %.
inline constexpr double kChiSquared3 = 11.345;

/// Returns the covariance of the position in ODOMETRY's pose_covariance, W, m².
Eigen::Matrix3d position_covariance(const std::array<double, 36>& pose_covariance);

/// Returns the stated 99 % bound of the position's error, √(χ² λ_max), m. It is the longest half axis of the ellipsoid
/// that holds the true position with this probability.
double stated_bound(const std::array<double, 36>& pose_covariance);

/// FLIGHT_RESULT.detail begins with this if the vehicle has believed to rest at its goal, but was elsewhere in truth.
inline constexpr std::string_view kReachedAsBelieved = "reached as believed";

}  // namespace tern
