// Coverage of prediction intervals: the share that covered, and their width, by class of track and time ahead.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/world/track.h"
#include "predictor/tracking/tracker.h"
#include "tools/calibrate/recording.h"

namespace tern::calibrate {

/// The intervals of one track in one cell: the unit that the bootstrap draws. An interval covers up to one of
/// kCoverageHorizons if the true box stayed inside the predicted one until then. Arrays are by level of confidence.
struct TrackIntervals {
  int intervals = 0;
  std::array<int, kLevels> covered{};
  std::array<double, kLevels> half_width_sum{};  ///< Σ of the half-width at that time, mean of the axes, m
};

/// All intervals of one class up to one time ahead.
struct CoverageCell {
  std::string what;  ///< "all moving", a class, an age of tracks, or a part of the recording
  double ahead_s = 0.0;
  std::vector<TrackIntervals> tracks;
};

/// The covered share with its 95 % interval, by a bootstrap over tracks (1000 draws from a fixed seed).
struct CellCoverage {
  int intervals = 0, tracks = 0;
  double share = 0.0, low = 0.0, high = 0.0;
  double mean_half_width = 0.0;  ///< m
};
CellCoverage cell_coverage(const CoverageCell& cell, int level);

/// Predictions are made at every kPredictEvery-th observation set, at the time when it was received. A predicted track
/// is compared with the obstacle whose centre is nearest at the prediction's start, if that is within
/// kMaxMatchDistance.
inline constexpr int kPredictEvery = 5;
inline constexpr double kMaxMatchDistance = 1.0;  ///< m

struct Study {
  double confidence = 0.99;                   ///< of level 0
  std::vector<CoverageCell> cells;            ///< ascending by what, then by ahead_s
  std::vector<ScoredPrediction> scored;       ///< of the tracker's own PredictionScorer
  std::vector<ScoredPrediction> scored_slow;  ///< those from recordings in which nothing reached kSlowSpeed
};

/// Feeds a recording to a new tracker.
Study study(const Recording& recording, const TrackerConfig& config);

/// CSV: a line per cell and level of confidence. "kept" is the covered share.
std::string coverage_table(const Study& study);

/// Adds `other` to `sum`, cell by cell.
void add(Study& sum, const Study& other);

}  // namespace tern::calibrate
