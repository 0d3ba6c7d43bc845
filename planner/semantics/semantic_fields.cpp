#include "planner/semantics/semantic_fields.h"

#include <algorithm>
#include <cmath>

#include "planner/semantics/distance_transform.h"
#include "planner/semantics/trilinear.h"

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

/// The smallest box of voxels (both corners included) that holds every voxel of the label; low > high when there is
/// none.
std::pair<Cell, Cell> bounds_of(const VoxelMap& map, VoxelLabel label) {
  Cell low = map.grid.size;
  Cell high = Cell::Constant(-1);
  std::size_t i = 0;
  for (int z = 0; z < map.grid.size.z(); ++z) {
    for (int y = 0; y < map.grid.size.y(); ++y) {
      for (int x = 0; x < map.grid.size.x(); ++x, ++i) {
        if (map.labels[i] != label) continue;
        low = low.cwiseMin(Cell(x, y, z));
        high = high.cwiseMax(Cell(x, y, z));
      }
    }
  }
  return {low, high};
}

/// Midpoint rule for ∫ f ds from a to b, samples at most `step` apart.
template <class F>
double integral(const Vec3& a, const Vec3& b, double step, const F& f) {
  const double length = (b - a).norm();
  const int n = std::max(1, static_cast<int>(length / step) + 1);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f(a + (b - a) * ((i + 0.5) / n));
  return sum * length / n;
}

}  // namespace

DistanceBand::DistanceBand(const VoxelMap& map, VoxelLabel label, double margin)
    : margin_(margin), inverse_step_(1.0 / map.grid.resolution) {
  const double r = map.grid.resolution;
  const auto [low, high] = bounds_of(map, label);
  const int pad = static_cast<int>(std::ceil(margin / r + 0.5)) + 1;
  const Cell first = low - Cell::Constant(pad);
  size_ = high - low + Cell::Constant(2 * pad + 1);
  std::vector<std::uint8_t> set(static_cast<std::size_t>(size_.cast<std::int64_t>().prod()), 0);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        if (map.labels[static_cast<std::size_t>(map.grid.index({x, y, z}))] != label) continue;
        const Eigen::Matrix<std::size_t, 3, 1> at = (Cell(x, y, z) - first).cast<std::size_t>();
        set[at.x() + static_cast<std::size_t>(size_.x()) * (at.y() + static_cast<std::size_t>(size_.y()) * at.z())] = 1;
      }
    }
  }
  distance_ = squared_distance_transform(set, size_);
  for (float& d : distance_) d = static_cast<float>(r * (std::sqrt(static_cast<double>(d)) - 0.5));
  window_ = {map.grid.centre(first), map.grid.centre(first + size_ - Cell::Ones())};
}

double DistanceBand::operator()(const Vec3& p) const {
  if (!window_.contains(p)) return margin_;
  return std::clamp(trilinear(distance_, size_, (p - window_.min()) * inverse_step_), 0.0, margin_);
}

SemanticFields::SemanticFields(const VoxelMap& map, const SemanticFieldsOptions& options)
    : version_(map.version), margin_(options.exposure_margin) {
  const auto prepare = [&](VoxelLabel label) -> std::optional<Label> {
    VoxelTree tree(map, label);
    if (tree.voxels() == 0) return std::nullopt;
    return Label{DistanceBand(map, label, margin_),
                 MeanDistanceField(std::move(tree), map.grid.resolution, map.grid.bounds(), options.mean_distance)};
  };
  attractive_ = prepare(VoxelLabel::Attractive);
  repulsive_ = prepare(VoxelLabel::Repulsive);
}

const std::optional<SemanticFields::Label>& SemanticFields::of(VoxelLabel label) const {
  static const std::optional<Label> kNone;
  if (label == VoxelLabel::Attractive) return attractive_;
  return label == VoxelLabel::Repulsive ? repulsive_ : kNone;
}

bool SemanticFields::has(VoxelLabel label) const { return of(label).has_value(); }

Box SemanticFields::influence(VoxelLabel label) const { return has(label) ? of(label)->band.window() : Box(); }

double SemanticFields::mean_distance(VoxelLabel label, const Vec3& p) const {
  const std::optional<Label>& fields = of(label);
  return fields ? fields->mean(p) : 0.0;
}

double SemanticFields::mean_distance_error(VoxelLabel label) const {
  const std::optional<Label>& fields = of(label);
  return fields ? fields->mean.error() : 0.0;
}

double SemanticFields::exposure_repulsive(const Vec3& p) const {
  return repulsive_ ? 1.0 - repulsive_->band(p) / margin_ : 0.0;
}

double SemanticFields::exposure_attractive(const Vec3& p) const {
  return attractive_ ? attractive_->band(p) / margin_ : 0.0;
}

double SemanticFields::exposure_repulsive(const Vec3& a, const Vec3& b) const {
  if (!repulsive_) return 0.0;
  return integral(a, b, 0.5 * margin_, [&](const Vec3& p) { return exposure_repulsive(p); });
}

double SemanticFields::exposure_attractive(const Vec3& a, const Vec3& b) const {
  if (!attractive_) return 0.0;
  return integral(a, b, 0.5 * margin_, [&](const Vec3& p) { return exposure_attractive(p); });
}

}  // namespace tern
