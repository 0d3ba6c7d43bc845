// What a predicted track promises: an α about a motion that holds at all times up to the horizon, on all axes at once.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "core/base/time.h"
#include "core/world/track.h"

namespace tern {

/// How far a filter's prediction looks, and how sure it is.
struct PredictionSpec {
  Duration horizon{4'500'000};  ///< > 0
  /// A piece is so long, or piece_growth times the time before it if that is more. Each piece carries its largest α,
  /// and α grows like t^1.5 (t² with accelerations), so that with 0.25 this is at most 1.4 (1.6) times its least, and
  /// few pieces (11 for the defaults) make small messages.
  Duration piece{250'000};     ///< > 0, ≤ horizon
  double piece_growth = 0.25;  ///< ≥ 0
  double confidence = 0.99;    ///< in (0, 1): probability that a track keeps its α over all its pieces
  double max_speed = 5.0;      ///< m/s per axis, > 0: nothing is believed to move faster

  /// Of a velocity of which nothing else is known, uniform in ±max_speed, m/s.
  [[nodiscard]] double speed_deviation() const { return max_speed / std::numbers::sqrt3; }
};

/// Where pieces begin and end: time since the prediction's start, ascending, from 0 to the horizon.
std::vector<Duration> piece_ends(const PredictionSpec& spec);

/// What one axis of an estimate says of the future.
struct AxisForecast {
  std::vector<double> mean;    ///< m, at the times of piece_ends
  std::vector<double> sigma;   ///< m, standard deviation there
  double crossings = 0.0;      ///< ∫ √(det P)/P_xx dt over the horizon, P of position and velocity
  double speed = 0.0;          ///< |v| at the start, m/s
  double max_curvature = 0.0;  ///< |mean''| is nowhere more, m/s²
};

/// P[the error leaves ±z σ(t) at any time in [0, horizon]] ≤ this, for one axis (a bound by Rice's formula):
///   erfc(z/√2) + e^{−z²/2}/π · ∫ √(det P(t))/P_xx(t) dt.
/// The first term is the error's start outside, the second the expected number of its outcrossings: ν = e(t)/σ(t) is a
/// Gaussian process of variance 1 whose derivative has variance det P/P_xx², since σσ̇ = P_xv.
/// S. O. Rice, "Mathematical analysis of random noise", 1945, §3.3.
double escape_probability(double z, double crossings);

/// The least z with escape_probability(z, crossings) ≤ probability. @pre 0 < probability < 1, crossings ≥ 0.
double quantile_for(double probability, double crossings);

/// One axis: line ends and half-widths at the times of piece_ends.
struct AxisTube {
  std::vector<double> centre;  ///< m
  std::vector<double> half;    ///< m, never falling
};

/// The region of one axis over time. The error stays inside z σ(t), and no speed exceeds u = max(max_speed, |v|), so
///   high(0) = x + zσ(0), high(t_k) = min(x + v t_k + z σ(t_k), high(t_{k−1}) + u (t_k − t_{k−1})), low alike;
/// centre and half-width are of [low, high]. high is convex and low concave, so between two times the chords contain
/// the region: a straight piece between the centres with the later half-width keeps the promise. Without the speed's
/// limit the centre is the predicted line; where it bites on one side only, the centre bends to the other. A mean that
/// accelerates leaves a chord of length h in time by at most |a| h²/8, which half[k] contains.
AxisTube axis_tube(const AxisForecast& forecast, double probability, const PredictionSpec& spec);

/// The motion and α of an estimate whose state is that of `start`. Each axis gets a third of 1 − confidence.
/// Sets motion, alpha, shares (the same formula at the lower levels of confidence, about the same centre) and top_speed
/// (max_speed, or the estimate's own speed if that is larger).
void predict_motion(const std::array<AxisForecast, 3>& axes, UTime start, const PredictionSpec& spec, Track& track);

}  // namespace tern
