// How dense the landmarks of one kind of surface are, given a label and what was seen.
#pragma once

#include <array>
#include <vector>

#include "planner/semantics/seen_cells.h"

namespace tern {

/// The posterior of a density ρ. The label gives a Gamma prior with mean a/b. It weighs as much as kPriorArea of seen
/// surface or kPriorCount landmarks, whichever is less. A cell with area A has a landmark with probability
/// 1 − exp(−ρA):
///
///     ln p(ρ) = a ln ρ − b ρ − ρ Σ_empty A + Σ_full ln(1 − exp(−ρA)) + const
///
/// This is concave; density() is its maximum. For cells that are small against 1/ρ it is (a + Σn)/(b + ΣA). Cells
/// fade with kForgotten, so that without sight the label counts again.
class DensityPosterior {
 public:
  static constexpr double kPriorArea = 6.0;   ///< m²
  static constexpr double kPriorCount = 6.0;  ///< largest a
  static constexpr double kForgotten = 30.0;  ///< s, to 1/e

  /// @param promised  by the label, 1/m², 0 … kMaxLandmarkDensity: larger ones are not told apart
  explicit DensityPosterior(double promised)
      : promised_(promised), prior_area_(kPriorArea * promised > kPriorCount ? kPriorCount / promised : kPriorArea) {}

  void fade(double seconds);
  /// Adds a cell of this kind.
  void add(const SurfaceCell& cell);
  /// Returns the density that maximizes the posterior, 1/m². Up to 100 evaluations of the derivative.
  [[nodiscard]] double density() const;
  [[nodiscard]] double promised() const { return promised_; }
  [[nodiscard]] double prior_area() const { return prior_area_; }

 private:
  /// Cells with a landmark, grouped by area so that the sum has a bounded number of terms. Each group counts with its
  /// mean area; groups are a factor 1.19 wide.
  struct Group {
    double count = 0.0, area = 0.0;
  };
  static constexpr int kGroups = 64;          ///< the first one also takes smaller cells, the last one larger ones
  static constexpr double kLeastArea = 1e-3;  ///< of a group, m²

  [[nodiscard]] double slope(double density) const;

  double promised_;
  double prior_area_;  ///< b, m²
  double empty_area_ = 0.0;
  std::array<Group, kGroups> full_{};
};

/// Whether these cells alone speak for more than this density: their likelihood increases there.
bool speak_for_more(const std::vector<SurfaceCell>& cells, SurfaceKind kind, double density);

}  // namespace tern
