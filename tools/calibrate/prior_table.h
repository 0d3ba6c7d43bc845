// The table that calibration begins with (predictor/tracking/calibration_prior.inc), made from scores.
#pragma once

#include <string>
#include <vector>

#include "predictor/tracking/judge.h"

namespace tern::calibrate {

/// The scores of one source, and what they weigh beside those of the others, > 0.
struct Source {
  std::string name;
  double weight = 1.0;
  std::vector<Judged> judged;
};

/// A class of one source with fewer promises than this says nothing.
inline constexpr std::size_t kFewPromises = 150;

/// The rows of the table: per class and band the level θ, and quantiles of the scores.
///
/// Margins are found band by band. Of the promises that the bands before have not broken, so many may break in this one
/// that all broken ones together are Calibration::allowed. The θ of a band is the share of all scores above that
/// margin. A source counts in a class by its weight and the share of its promises that are of that class.
std::string prior_table(const std::vector<Source>& sources);

}  // namespace tern::calibrate
