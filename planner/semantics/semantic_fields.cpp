#include "planner/semantics/semantic_fields.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "planner/semantics/distance_transform.h"
#include "planner/semantics/trilinear.h"

namespace tern {
namespace {

using Cell = Eigen::Vector3i;

/// Returns the smallest box of voxels, both corners included, that contains every voxel of the kind; low > high if
/// there is none.
std::pair<Cell, Cell> bounds_of(const VoxelMap& map, const VoxelKind& kind) {
  Cell low = map.grid.size;
  Cell high = Cell::Constant(-1);
  std::size_t i = 0;
  for (int z = 0; z < map.grid.size.z(); ++z) {
    for (int y = 0; y < map.grid.size.y(); ++y) {
      for (int x = 0; x < map.grid.size.x(); ++x, ++i) {
        if (!kind.has(map, i)) continue;
        low = low.cwiseMin(Cell(x, y, z));
        high = high.cwiseMax(Cell(x, y, z));
      }
    }
  }
  return {low, high};
}

/// Returns the range of the segment's parameter, within 0 … 1, that lies in the box; first > second if there is none.
std::pair<double, double> part_inside(const Vec3& a, const Vec3& b, const Box& box) {
  double from = 0.0;
  double to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0.0) {
      if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return {1.0, 0.0};
      continue;
    }
    const double t0 = (box.min()[axis] - a[axis]) / d;
    const double t1 = (box.max()[axis] - a[axis]) / d;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return {from, to};
}

/// λ by class index, for voxels of one label.
std::vector<double> lambdas_of(const VoxelMap& map, double of_label, const SemanticFieldsOptions& options) {
  std::vector<double> lambdas(256, of_label);
  for (const auto& [name, lambda] : options.class_lambdas) {
    for (std::size_t c = 1; c < map.class_names.size(); ++c) {
      if (map.class_names[c] == name) lambdas[c] = lambda;
    }
  }
  return lambdas;
}

}  // namespace

DistanceBand::DistanceBand(const VoxelMap& map, const VoxelKind& kind, double margin)
    : margin_(margin), inverse_step_(1.0 / map.grid.resolution) {
  const double r = map.grid.resolution;
  const auto [low, high] = bounds_of(map, kind);
  const int pad = static_cast<int>(std::ceil(margin / r + 0.5)) + 1;
  const Cell first = low - Cell::Constant(pad);
  size_ = high - low + Cell::Constant(2 * pad + 1);
  std::vector<std::uint8_t> set(static_cast<std::size_t>(size_.cast<std::int64_t>().prod()), 0);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        if (!kind.has(map, idx(map.grid.index({x, y, z})))) continue;
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
  prepare(map, VoxelLabel::Attractive, options);
  prepare(map, VoxelLabel::Repulsive, options);
}

void SemanticFields::prepare(const VoxelMap& map, VoxelLabel label, const SemanticFieldsOptions& options) {
  const bool attracts = label == VoxelLabel::Attractive;
  const std::vector<double> lambdas =
      lambdas_of(map, attracts ? options.lambda_attractive : options.lambda_repulsive, options);
  const std::size_t first = groups_.size();
  std::bitset<256> done;
  double voxels = 0.0;
  for (std::size_t c = 0; c < std::max<std::size_t>(map.class_names.size(), 1); ++c) {
    if (done[c]) continue;
    std::bitset<256> same;
    for (std::size_t other = 0; other < lambdas.size(); ++other) same[other] = lambdas[other] == lambdas[c];
    done |= same;
    const VoxelKind kind(label, same);
    VoxelTree tree(map, kind);
    if (tree.voxels() == 0) continue;
    const auto n = static_cast<double>(tree.voxels());
    voxels += n;
    groups_.push_back(
        {label, lambdas[c], n, DistanceBand(map, kind, margin_),
         MeanDistanceField(std::move(tree), map.grid.resolution, map.grid.bounds(), options.mean_distance)});
    if (lambdas[c] <= 0.0) continue;
    influence_.extend(groups_.back().band.window());
    if (attracts) strongest_attraction_ = std::max(strongest_attraction_, lambdas[c]);
  }
  for (std::size_t g = first; g < groups_.size(); ++g) groups_[g].share /= voxels;
}

bool SemanticFields::has(VoxelLabel label) const {
  return std::any_of(groups_.begin(), groups_.end(), [&](const Group& g) { return g.label == label; });
}

bool SemanticFields::has_weight() const { return !influence_.isEmpty(); }

bool SemanticFields::varies_in(const Box& box) const {
  return std::any_of(groups_.begin(), groups_.end(),
                     [&](const Group& g) { return g.lambda > 0.0 && g.band.window().intersects(box); });
}

double SemanticFields::exposure_cost(VoxelLabel label, const Vec3& p) const {
  double strongest = 0.0;
  for (const Group& g : groups_) {
    if (g.label == label && g.lambda > 0.0) strongest = std::max(strongest, g.lambda * (1.0 - g.band(p) / margin_));
  }
  return label == VoxelLabel::Attractive ? strongest_attraction_ - strongest : strongest;
}

template <class Rate>
double SemanticFields::integral(const Vec3& a, const Vec3& b, double outside, const Rate& rate) const {
  const double length = (b - a).norm();
  const auto [from, to] = has_weight() ? part_inside(a, b, influence_) : std::pair(1.0, 0.0);
  if (!(from < to)) return outside * length;
  const double inside = (to - from) * length;
  const int n = static_cast<int>(inside / (0.5 * margin_)) + 1;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += rate(a + (b - a) * (from + (to - from) * ((i + 0.5) / n)));
  return outside * (length - inside) + sum * inside / n;
}

double SemanticFields::exposure_cost(VoxelLabel label, const Vec3& a, const Vec3& b) const {
  const double outside = label == VoxelLabel::Attractive ? strongest_attraction_ : 0.0;
  return integral(a, b, outside, [&](const Vec3& p) { return exposure_cost(label, p); });
}

double SemanticFields::exposure_cost(const Vec3& a, const Vec3& b) const {
  return integral(a, b, strongest_attraction_, [&](const Vec3& p) {
    return exposure_cost(VoxelLabel::Attractive, p) + exposure_cost(VoxelLabel::Repulsive, p);
  });
}

double SemanticFields::mean_distance_cost(VoxelLabel label, const Vec3& p) const {
  double sum = 0.0;
  for (const Group& g : groups_) {
    if (g.label == label && g.lambda > 0.0) sum += g.lambda * g.share * g.mean(p);
  }
  return sum;
}

double SemanticFields::mean_distance_cost(const Vec3& p) const {
  return mean_distance_cost(VoxelLabel::Attractive, p) - mean_distance_cost(VoxelLabel::Repulsive, p);
}

}  // namespace tern
