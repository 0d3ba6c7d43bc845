// The densities of landmarks that ways are priced by: those of the labels, corrected by what is really seen.
#pragma once

#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/world/landmark_densities.h"
#include "planner/semantics/density_posterior.h"

namespace tern {

/// Keeps a posterior per kind of surface, and the densities in force.
///
/// | event                                                  | effect                                               |
/// |--------------------------------------------------------|------------------------------------------------------|
/// | a frame                                                | earlier ones fade, and its cells count               |
/// | a full frame: the camera may have left out landmarks   | cells count if they speak for more than the density  |
/// | a density is kHysteresis steps from the one in force   | kHeld after the last change: the nearest step is     |
///
/// Steps are factors of kStep from the label's density, both raised by kBlur: below that, differences do not matter. So
/// the densities in force change seldom, and goal fields with them. Deterministic.
class LabelDensities {
 public:
  static constexpr double kStep = 1.25;
  static constexpr double kHysteresis = 2.0;
  static constexpr double kBlur = 0.02;  ///< 1/m²
  static constexpr Duration kHeld{1'000'000};

  explicit LabelDensities(SurfaceDensities promised);

  /// Adds the cells of one frame.
  /// @param is_full  the frame has as many tracks as the camera keeps  @param at  ascending
  /// @return whether the densities in force changed
  bool add(const std::vector<SurfaceCell>& cells, bool is_full, UTime at);

  /// The densities in force; nullopt while all are those of the labels.
  [[nodiscard]] std::optional<SurfaceDensities> in_force() const;
  [[nodiscard]] const SurfaceDensities& promised() const { return promised_; }
  /// Returns the density as seen so far, 1/m².
  [[nodiscard]] double seen(SurfaceKind kind) const { return posteriors_[place(kind)].density(); }
  /// Returns the density of one kind in force, 1/m².
  [[nodiscard]] double in_force(SurfaceKind kind) const;

 private:
  /// Open ground, the classes, then obstacles.
  [[nodiscard]] std::size_t place(SurfaceKind kind) const {
    return kind == kObstacles ? posteriors_.size() - 1 : idx(kind);
  }

  SurfaceDensities promised_;
  std::vector<DensityPosterior> posteriors_;
  std::vector<int> steps_;  ///< in force, from the label's density
  std::optional<UTime> last_, changed_;
};

}  // namespace tern
