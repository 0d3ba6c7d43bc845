// What a predicted track promises: an α about a motion that holds at all times up to the horizon, on all axes at once.
#pragma once

#include <array>
#include <vector>

#include "core/base/time.h"
#include "core/world/track.h"

namespace tern {

/// How far predictions look, and how sure they are.
struct PredictionSpec {
  Duration horizon{4'500'000};  ///< > 0
  /// A piece is so long, or piece_growth times the time before it if that is more. Each piece carries its largest α, so
  /// that short pieces make a small α and long messages: 18 of them for the defaults.
  Duration piece{100'000};    ///< > 0, ≤ horizon
  double piece_growth = 0.2;  ///< ≥ 0
  double confidence = 0.99;   ///< in (0, 1): probability that a track keeps its α
  /// m/s per axis, > 0: what is new or starts is believed to move no faster, unless something faster was seen.
  double max_speed = 5.0;
};

/// Where pieces begin and end: time since the prediction's start, ascending, from 0 to the horizon.
std::vector<Duration> piece_ends(const PredictionSpec& spec);

/// P[the error leaves ±z σ(t) at any time in [0, horizon]] ≤ this, for one axis (a bound by Rice's formula):
///   erfc(z/√2) + e^{−z²/2}/π · ∫ √(det P(t))/P_xx(t) dt, P of position and velocity.
/// The first term is the error's start outside, the second the expected number of its outcrossings: ν = e(t)/σ(t) is a
/// Gaussian process of variance 1 whose derivative has variance det P/P_xx², since σσ̇ = P_xv.
/// S. O. Rice, "Mathematical analysis of random noise", 1945, §3.3.
/// @param crossings the integral, ≥ 0.
double escape_probability(double z, double crossings);

/// The least z with escape_probability(z, crossings) ≤ probability. @pre 0 < probability < 1, crossings ≥ 0.
double escape_quantile(double probability, double crossings);

/// A prediction at one of piece_ends.
struct Waypoint {
  Vec3 centre = Vec3::Zero();                            ///< W, m
  Vec3 velocity = Vec3::Zero();                          ///< m/s
  std::array<Vec3, kConfidenceLevels.size()> half = {};  ///< half-width per level of confidence, m, ≥ 0
};

/// Motion, α, shares and top speed of a track from waypoints at `ends`, which are piece_ends.
///
/// The centre is the cubic Hermite curve through them. α of a piece is the largest half-width up to its end, but on no
/// axis more than the reach set allows: who was within half(0) at the start, and is no faster than `speed`, is within
/// half(0) + |centre(t) − centre(0)| + speed t of the centre. At lower levels likewise, and no more than at the level
/// before; a share is the largest of the three axes'.
/// @param speed m/s per axis, > 0: the track's top speed.
void set_motion(const std::vector<Waypoint>& waypoints, const std::vector<Duration>& ends, UTime start, double speed,
                Track& track);

}  // namespace tern
