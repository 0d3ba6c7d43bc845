// Makes the prior of the calibration (predictor/tracking/calibration_prior.inc) from scores.
#pragma once

#include <string>
#include <vector>

#include "predictor/tracking/prediction_scorer.h"

namespace tern::calibrate {

/// The scores of one source: a log, or one kind of synthetic motion.
struct Source {
  std::string name;
  double weight = 1.0;  ///< w in (0, 1]: its miss rate may be 1/w times the allowed one
  std::vector<ScoredPrediction> scored;
};

/// A source with fewer predictions of a class is ignored for that class.
inline constexpr std::size_t kMinPredictions = 150;

/// Returns the text of calibration_prior.inc: two tables, one from all sources, one from their slow recordings. A row
/// per class and band holds the level θ of each confidence and quantiles of the scores.
///
/// A flight does not know which kind of motion it will meet, so the prior covers each source by itself instead of their
/// average:
/// 1. For each source, its miss rate times its weight is at most Calibration::allowed.
/// 2. The quantile at p is the largest of the sources' quantiles at 1 − (1 − p)/weight.
/// 3. A source's weight for a class is its own weight times 3 s, at most its own. s is the share of the class's motion
///    (steady, calm or lively) among the source's predictions of that age. So each motion may use a third of what is
///    allowed.
/// 4. Margins are found band by band. A prediction that an earlier band missed is not missed again by a later one.
/// 5. θ is the share of scores above the margin, at most what is allowed and at least a tenth of it.
/// 6. The slow table repeats a row of the first table if slow recordings have too few predictions, or would give a
///    wider margin.
///
/// @throws std::runtime_error if no source has kMinPredictions of a class, evaluated to the end of each band
std::string prior_table(const std::vector<Source>& sources, const std::vector<Source>& slow_sources);

}  // namespace tern::calibrate
