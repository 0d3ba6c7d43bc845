#include "planner/semantics/density_posterior.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// The derivative of ln(1 − exp(−ρA)).
double slope_of_full(double density, double area) { return area / std::expm1(density * area); }

constexpr double kLeastDensity = 1e-4;  ///< 1/m²: lower ones are not told apart

}  // namespace

void DensityPosterior::fade(double seconds) {
  const double left = std::exp(-seconds / kForgotten);
  empty_area_ *= left;
  for (Group& group : full_) {
    group.count *= left;
    group.area *= left;
  }
}

void DensityPosterior::add(const SurfaceCell& cell) {
  if (!cell.has_landmark) {
    empty_area_ += cell.area_m2;
    return;
  }
  const double at = 4.0 * std::log2(cell.area_m2 / kLeastArea);
  Group& group = full_[idx(static_cast<int>(std::clamp(at, 0.0, kGroups - 1.0)))];
  group.count += 1.0;
  group.area += cell.area_m2;
}

double DensityPosterior::slope(double density) const {
  double sum = prior_area_ * (promised_ / density - 1.0) - empty_area_;
  for (const Group& group : full_) {
    if (group.count > 0.0) sum += group.count * slope_of_full(density, group.area / group.count);
  }
  return sum;
}

double DensityPosterior::density() const {
  if (slope(kLeastDensity) <= 0.0) return kLeastDensity;
  double low = kLeastDensity, high = kMaxLandmarkDensity;  // the slope decreases
  while (high > low * (1.0 + 1e-6)) {
    const double middle = std::sqrt(low * high);
    (slope(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

bool speak_for_more(const std::vector<SurfaceCell>& cells, SurfaceKind kind, double density) {
  double slope = 0.0;
  for (const SurfaceCell& cell : cells) {
    if (cell.kind == kind) slope += cell.has_landmark ? slope_of_full(density, cell.area_m2) : -cell.area_m2;
  }
  return slope > 0.0;
}

}  // namespace tern
