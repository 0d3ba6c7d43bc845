// The table that calibration begins with (predictor/tracking/calibration_prior.inc), made from scores.
#pragma once

#include <string>
#include <vector>

#include "predictor/tracking/judge.h"

namespace tern::calibrate {

/// The scores of one source, and how much is promised of it, in (0, 1]: 1 where all is.
struct Source {
  std::string name;
  double weight = 1.0;
  std::vector<Judged> judged;
};

/// A class of one source with fewer promises than this says nothing.
inline constexpr std::size_t kFewPromises = 150;

/// calibration_prior.inc: two tables, of all sources, then of their slow recordings. A row is per class and band the
/// level θ for each confidence, and quantiles of the scores.
///
/// A flight does not know in which world it is, so the promise is to hold in each. For no source may its broken
/// promises, times its weight, be more than Calibration::allowed. The quantile at p is the largest of the sources' at 1
/// − (1 − p)/weight. Where few of a source's promises of an age are of one kind of motion, it counts there by three
/// times their share. So each kind may break a third of what is allowed. Margins are found band by band: of the
/// promises that the bands before have not broken, so many may break in this one. θ is the share of the scores of that
/// distribution above the margin, at most what is allowed. A class that slow recordings do not know well is
/// that of all, and so is a row that promises less.
std::string prior_table(const std::vector<Source>& sources, const std::vector<Source>& slow_sources);

}  // namespace tern::calibrate
