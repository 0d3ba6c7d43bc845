// Promised against kept: how often, and how wide, by class of track and time ahead.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/world/track.h"
#include "predictor/tracking/tracker.h"
#include "tools/calibrate/recording.h"

namespace tern::calibrate {

/// Kept: the true box was inside the promised one at all times up to there, s.
inline constexpr std::array<double, 5> kCoveredAhead{0.25, 0.5, 1.0, 2.0, 4.5};

/// The promises of one track of one class up to one time ahead: what a bootstrap draws. By level of confidence.
struct TrackPromises {
  int promises = 0;
  std::array<int, kLevels> kept{};
  std::array<double, kLevels> half_sum{};  ///< Σ of the half-width there, mean of the axes, m
};

/// The promises of one class up to one time ahead.
struct CoverageCell {
  std::string what;  ///< class, the track's age, or how old the flight is: for so long anything was learnt
  double ahead_s = 0.0;
  std::vector<TrackPromises> tracks;
};

/// A share and the ends of its 95 % interval, by a bootstrap over tracks (1000 draws from a fixed seed).
struct Covered {
  int promises = 0, tracks = 0;
  double share = 0.0, low = 0.0, high = 0.0;
  double half_m = 0.0;  ///< mean half-width
};
Covered covered(const CoverageCell& cell, int level);

/// A prediction is made each kEvery observation sets, at the time when the set was received. What its tracks promise is
/// held against the obstacle whose centre is nearest at its start, if that is within kSameThing.
inline constexpr int kEvery = 5;
inline constexpr double kSameThing = 1.0;  ///< m

struct Study {
  double confidence = 0.99;         ///< promised
  std::vector<CoverageCell> cells;  ///< by class, then by the track's age
  std::vector<Judged> judged;       ///< the tracker's own scores …
  std::vector<Judged> slow;         ///< … those in slow worlds
};

/// Feeds a recording to a tracker that is new.
Study study(const Recording& recording, const TrackerConfig& config);

/// A line of CSV per cell and level of confidence, with its interval.
std::string coverage_table(const Study& study);

/// `other` is added to `sum`, cell by cell.
void add(Study& sum, const Study& other);

}  // namespace tern::calibrate
