// Corrects the densities of landmarks that labels promise, by the features that a camera tracks in flight.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/world/inertial.h"
#include "planner/planning_world.h"
#include "planner/semantics/label_densities.h"
#include "planner/static_tracks.h"

namespace tern {

/// Pairs frames of features with poses, and keeps LabelDensities.
///
/// | input                                                   | effect                                       |
/// |---------------------------------------------------------|----------------------------------------------|
/// | a frame with features, kPeriod after the last used one  | it waits for its pose                        |
/// | any other frame                                         | ignored                                      |
/// | a pose, at most kPairWithin after the waiting frame     | the frame's cells count (seen_cells)         |
/// | one that is later, or not Tracking                      | the waiting frame is dropped                 |
/// | one whose error exceeds kMostError                      | the same                                     |
/// | one when predictions are older than kOldestTracks       | the same                                     |
/// | a map with other classes                                | the densities are those of the labels again  |
///
/// A frame without features may come from a covered camera. Successive frames see the same landmarks, hence kPeriod.
/// Deterministic.
class DensityWatch {
 public:
  static constexpr Duration kPeriod{500'000}, kPairWithin{100'000}, kOldestTracks{500'000};
  static constexpr double kMostError = 1.5;  ///< of the camera's place, 99 %, m

  void add(const FeatureFrame& frame);

  /// Takes a pose, and with it the frame that waits for one.
  /// @param predictions  null: none yet @param obstacles  those that paths to the goal avoid
  /// @return a line for each kind whose density in force is new by more than a factor of 2
  std::vector<std::string> add(const Odometry& odometry, const MapProducts& map, const PredictionProducts* predictions,
                               const PathObstacles& obstacles);

  /// The densities in force for a map; nullopt: those of the labels.
  [[nodiscard]] std::optional<SurfaceDensities> densities_for(const MapProducts& map) const;
  /// The densities so far; null before the first frame that was used.
  [[nodiscard]] const LabelDensities* densities() const { return densities_ ? &*densities_ : nullptr; }
  /// Frames that were used.
  [[nodiscard]] std::int64_t used() const { return used_; }

 private:
  void begin(const MapProducts& map);
  [[nodiscard]] std::vector<std::string> news();

  std::optional<FeatureFrame> waiting_;
  std::optional<UTime> last_;  ///< of the frames that were used
  std::vector<std::string> class_names_;
  std::optional<LabelDensities> densities_;
  std::vector<double> told_;  ///< by class, then of obstacles: the density of the last line
  std::int64_t used_ = 0;
};

}  // namespace tern
