// How the error of a visual-inertial estimate grows: with the information in view, and superlinearly with blind time.
#pragma once

#include <vector>

#include "core/base/types.h"

namespace tern {

/// Noise densities of an inertial sensor in flight. Data sheets (Allan) state ten times less for the force, because
/// vibration, scale and mounting errors are not in them.
struct InertialNoise {
  double force = 2.8e-2;       ///< a_n, m/s²/√Hz
  double force_walk = 3e-3;    ///< a_w, m/s³/√Hz
  double rate = 3.4e-4;        ///< g_n, rad/s/√Hz
  double rate_walk = 1.94e-5;  ///< g_w, rad/s²/√Hz
  double force_bias = 0.03;    ///< σ at the start, m/s²
  double rate_bias = 2e-4;     ///< σ at the start, rad/s
};
inline constexpr InertialNoise kFlightNoise;

/// The filter's deviations when the view goes dark, as measured while it sees.
struct SightedSigma {
  double velocity = 0.0175;     ///< σ_v per axis, m/s
  double acceleration = 0.014;  ///< σ_a: of tilt and accelerometer bias together, per axis, m/s²
  double rate_bias = 1e-4;      ///< σ_bg, rad/s
};
inline constexpr SightedSigma kSightedSigma;

/// Returns the variance of the position, all three axes together, after τ seconds without landmarks, m². For a
/// horizontal axis it is
///
///     σ_v²τ² + ¼σ_a²τ⁴ + a_n²τ³/3 + a_w²τ⁵/20 + g²g_n²τ⁵/20 + g²σ_bg²τ⁶/36
///
/// and for the vertical one the same without the two terms of g, as tilt does not turn gravity into it.
double dark_variance(double dark_s);
/// Returns its derivative, m²/s.
double dark_growth(double dark_s);

/// Returns the growth of the position's variance while landmarks give frame pairs of this deviation, m²/s:
/// (κ σ_t)²/Δt, κ = kTrackGain. κ stands for tracks that live longer than a pair.
double sighted_growth(double translation_m, double frame_s);

/// Blind time at which an estimate grows no slower without landmarks than with these: the τ with dark_growth(τ) = rate,
/// at most kLongestDark. In a place with little to see an estimate grows as fast as one that is blind for this long.
double equal_dark_time(double growth);

/// Calibrated on flights of tern-estimator, docs/lab/2026-11-27-semantics-by-belief.md.
inline constexpr double kTrackGain = 0.39;
inline constexpr double kLongestDark = 60.0;  ///< s

/// The drift of a way, from the goal backwards (or forwards: it is the same).
struct Drift {
  double way = 0.0;           ///< m
  double variance = 0.0;      ///< of the position at the goal, without the part of the initial tilt, m²
  double dark_s = 0.0;        ///< blind time at the way's open end, s
  double largest_dark = 0.0;  ///< largest variance of a blind stretch, m²

  /// Continues the way by a step of this length and time through a place with these growths.
  /// @param growth  sighted_growth(), m²/s  @param equal_dark_s  equal_dark_time(growth)
  void extend(double length, double seconds, double growth, double equal_dark_s);
  /// σ of the position at the goal, and at the worst place, m.
  [[nodiscard]] double at_goal() const;
  [[nodiscard]] double at_worst() const;
};

/// Share of a blind stretch's variance that remains when landmarks are back. Position and velocity are correlated, so
/// a seen velocity corrects the position as well.
inline constexpr double kDarkKept = 0.15;
/// Drift along a straight way that sees everything, m/m: tilt and accelerometer bias cannot be told apart.
inline constexpr double kTiltDrift = 2.7e-3;

}  // namespace tern
