#include "planner/semantics/label_densities.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tern {
namespace {

double at_step(double promised, int step) {
  if (step == 0) return promised;
  const double raised = (promised + LabelDensities::kBlur) * std::pow(LabelDensities::kStep, step);
  return std::min(std::max(raised - LabelDensities::kBlur, 0.0), kMaxLandmarkDensity);
}

double steps_to(double promised, double density) {
  return std::log((density + LabelDensities::kBlur) / (promised + LabelDensities::kBlur)) /
         std::log(LabelDensities::kStep);
}

}  // namespace

LabelDensities::LabelDensities(SurfaceDensities promised) : promised_(std::move(promised)) {
  for (const double density : promised_.by_class) posteriors_.emplace_back(density);
  posteriors_.emplace_back(promised_.obstacles);
  steps_.assign(posteriors_.size(), 0);
}

bool LabelDensities::add(const std::vector<SurfaceCell>& cells, bool is_full, UTime at) {
  const double seconds = last_ ? (at - *last_).seconds() : 0.0;
  last_ = at;
  for (DensityPosterior& posterior : posteriors_) posterior.fade(seconds);
  std::vector<bool> counts(posteriors_.size(), true);
  if (is_full) {
    for (std::size_t k = 0; k < posteriors_.size(); ++k) {
      const auto kind = k + 1 == posteriors_.size() ? kObstacles : static_cast<SurfaceKind>(k);
      counts[k] = speak_for_more(cells, kind, posteriors_[k].density());
    }
  }
  for (const SurfaceCell& cell : cells) {
    if (counts[place(cell.kind)]) posteriors_[place(cell.kind)].add(cell);
  }
  if (changed_ && at - *changed_ < kHeld) return false;
  bool changed = false;
  for (std::size_t k = 0; k < posteriors_.size(); ++k) {
    const double step = steps_to(posteriors_[k].promised(), posteriors_[k].density());
    if (std::abs(step - steps_[k]) < kHysteresis) continue;
    steps_[k] = static_cast<int>(std::lround(step));
    changed = true;
  }
  if (changed) changed_ = at;
  return changed;
}

double LabelDensities::in_force(SurfaceKind kind) const {
  return at_step(posteriors_[place(kind)].promised(), steps_[place(kind)]);
}

std::optional<SurfaceDensities> LabelDensities::in_force() const {
  if (std::all_of(steps_.begin(), steps_.end(), [](int step) { return step == 0; })) return std::nullopt;
  SurfaceDensities densities{in_force(kObstacles), {}};
  for (std::size_t c = 0; c < promised_.by_class.size(); ++c) {
    densities.by_class.push_back(in_force(static_cast<SurfaceKind>(c)));
  }
  return densities;
}

}  // namespace tern
