// Prediction intervals of a track: the box of centre, half-extents and α over each piece of the horizon.
// Steps 9 and 10 of docs/prediction.md.
#pragma once

#include <array>
#include <vector>

#include "core/base/time.h"
#include "core/world/track.h"

namespace tern {

struct PredictionSpec {
  Duration horizon{4'500'000};  ///< > 0
  /// A piece lasts this long, or piece_growth times the time before it if that is longer. A piece carries its largest
  /// α, so short pieces make α small and messages long. The defaults make 18 pieces.
  Duration piece{100'000};    ///< > 0, ≤ horizon
  double piece_growth = 0.2;  ///< ≥ 0
  double confidence = 0.99;   ///< in (0, 1): probability that the intervals cover a track over the whole horizon.
  /// Largest speed of a new or starting track, m/s per axis, > 0, unless a faster one was seen.
  double max_speed = 5.0;
};

/// Returns the boundaries of the pieces: times since the prediction's start, ascending, from 0 to the horizon.
std::vector<Duration> piece_ends(const PredictionSpec& spec);

/// Returns an upper bound of the probability that the error on one axis leaves ±z σ(t) within the horizon, by Rice's
/// formula. With P the covariance of position and velocity it is
///   erfc(z/√2) + e^{−z²/2}/π · ∫ √(det P(t))/P_xx(t) dt.
/// The first term is the probability to start outside. The second is the expected number of outcrossings. They are
/// those of ν = e(t)/σ(t), a Gaussian process of variance 1 whose derivative has variance det P/P_xx², since σσ̇ = P_xv.
/// S. O. Rice, "Mathematical analysis of random noise", 1945, §3.3. @param crossings the integral, ≥ 0
double escape_probability(double z, double crossings);

/// Returns the least z with escape_probability(z, crossings) ≤ probability. @pre 0 < probability < 1, crossings ≥ 0
double escape_quantile(double probability, double crossings);

/// The prediction at one of piece_ends().
struct Waypoint {
  Vec3 centre = Vec3::Zero();                            ///< W, m
  Vec3 velocity = Vec3::Zero();                          ///< m/s
  std::array<Vec3, kConfidenceLevels.size()> half = {};  ///< half-width per level of confidence, m, ≥ 0
};

/// Sets motion, α, shares and top speed of a track from waypoints at `ends`, which are piece_ends().
///
/// - The centre is the cubic Hermite curve through the waypoints.
/// - α of a piece is the largest half-width up to its end, bounded by the reach set. An obstacle that starts within
///   half(0) and is no faster than `speed` stays within half(0) + |centre(t) − centre(0)| + speed t of the centre.
/// - Each lower level follows the same rule, and is at most the level before it. Its shares are per axis.
/// @param speed m/s per axis, > 0: the track's top speed
void set_motion(const std::vector<Waypoint>& waypoints, const std::vector<Duration>& ends, UTime start, double speed,
                Track& track);

}  // namespace tern
