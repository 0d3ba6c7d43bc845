#include "planner/semantics/surface_map.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// Returns the promised density of each class of the map, [0]: of open ground.
std::vector<double> densities_of(const VoxelMap& map, const LandmarkPriors& priors) {
  std::vector<double> densities(std::max<std::size_t>(map.class_names.size(), 1), priors.ground);
  for (const auto& [name, density] : priors.regions) {
    for (std::size_t c = 1; c < map.class_names.size(); ++c) {
      if (map.class_names[c] == name) densities[c] = density;
    }
  }
  return densities;
}

bool is_region(VoxelLabel label) { return label == VoxelLabel::Attractive || label == VoxelLabel::Repulsive; }

void raise_sides(SurfaceColumn& column, SurfaceKind kind, double density, const Box& box) {
  const auto low = static_cast<float>(box.min().z()), high = static_cast<float>(box.max().z());
  const bool had_none = column.sides == 0.0f;
  column.low = had_none ? low : std::min(column.low, low);
  column.high = had_none ? high : std::max(column.high, high);
  if (static_cast<float>(density) <= column.sides) return;
  column.sides = static_cast<float>(density);
  column.sides_kind = kind;
}

}  // namespace

SurfaceMap::SurfaceMap(const VoxelMap& map, const LandmarkPriors& priors)
    : open_{static_cast<float>(priors.ground)}, obstacles_(priors.obstacles), ground_z_(priors.ground_z_m) {
  promised_ = {priors.obstacles, densities_of(map, priors)};
  const std::vector<double>& densities = promised_.by_class;
  const auto counts = [&](std::size_t i) { return is_region(map.labels[i]) || map.labels[i] == VoxelLabel::Occupied; };
  const auto voxels = static_cast<std::size_t>(map.grid.voxels());
  for (std::size_t i = 0; i < voxels; ++i) {
    if (counts(i)) extent_.extend(map.grid.box(map.grid.cell(static_cast<std::int64_t>(i))));
  }
  lay_grid(extent_);
  std::vector<bool> has_ground(columns_.size(), false);
  for (std::size_t i = 0; i < voxels; ++i) {  // z runs slowest, so that the lowest region counts
    if (!counts(i)) continue;
    const Box box = map.grid.box(map.grid.cell(static_cast<std::int64_t>(i)));
    if (map.labels[i] == VoxelLabel::Occupied) {
      put_obstacle(box);
      continue;
    }
    const int k = column_of(box.center().x(), box.center().y());
    SurfaceColumn& column = columns_[idx(k)];
    const SurfaceKind kind = map.classes[i];
    const double density = densities.at(idx(kind));
    if (!has_ground[idx(k)]) {
      column.ground = static_cast<float>(density);
      column.ground_kind = kind;
    }
    has_ground[idx(k)] = true;
    if (density > priors.ground) raise_sides(column, kind, density, box);
  }
}

SurfaceMap SurfaceMap::with_densities(const SurfaceDensities& densities) const {
  const auto density_of = [&](SurfaceKind kind) {
    return static_cast<float>(kind == kObstacles ? densities.obstacles : densities.by_class.at(idx(kind)));
  };
  SurfaceMap made = *this;
  made.obstacles_ = densities.obstacles;
  made.open_.ground = density_of(kOpenGround);
  for (SurfaceColumn& column : made.columns_) {
    column.ground = density_of(column.ground_kind);
    if (column.sides > 0.0f) column.sides = density_of(column.sides_kind);
  }
  return made;
}

SurfaceMap SurfaceMap::with_obstacles(const std::vector<Box>& boxes) const {
  SurfaceMap made = *this;
  for (const Box& box : boxes) made.extent_.extend(box);
  made.lay_grid(made.extent_);
  std::size_t k = 0;
  for (int row = 0; row < made.ny_; ++row) {
    for (int column = 0; column < made.nx_; ++column) {
      made.columns_[k++] = at(made.x0_ + (column + 0.5) * made.step_, made.y0_ + (row + 0.5) * made.step_);
    }
  }
  for (const Box& box : boxes) made.put_obstacle(box);
  return made;
}

void SurfaceMap::lay_grid(const Box& bounds) {
  columns_.clear();
  nx_ = ny_ = 0;
  if (bounds.isEmpty()) return;
  const auto count = [](double length, double step) { return std::floor(length / step) + 1.0; };
  const Vec3 size = bounds.sizes();
  while (count(size.x(), step_) * count(size.y(), step_) > kMaxColumns) step_ *= 1.05;
  x0_ = bounds.min().x();
  y0_ = bounds.min().y();
  nx_ = static_cast<int>(count(size.x(), step_));
  ny_ = static_cast<int>(count(size.y(), step_));
  columns_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), open_);
}

void SurfaceMap::put_obstacle(const Box& box) {
  const auto cell = [this](double at, double from, int n) {
    return std::clamp(static_cast<int>(std::floor((at - from) / step_)), 0, n - 1);
  };
  for (int j = cell(box.min().y(), y0_, ny_); j <= cell(box.max().y() - 1e-9, y0_, ny_); ++j) {
    for (int i = cell(box.min().x(), x0_, nx_); i <= cell(box.max().x() - 1e-9, x0_, nx_); ++i) {
      SurfaceColumn& column = columns_[idx(j * nx_ + i)];
      raise_sides(column, kObstacles, obstacles_, box);
      column.is_opaque = true;
    }
  }
}

int SurfaceMap::column_of(double x, double y) const {
  const double inverse = 1.0 / step_, i = (x - x0_) * inverse, j = (y - y0_) * inverse;
  if (!(i >= 0.0 && i < nx_ && j >= 0.0 && j < ny_)) return -1;
  return static_cast<int>(j) * nx_ + static_cast<int>(i);
}

const SurfaceColumn& SurfaceMap::at(double x, double y) const {
  const int k = column_of(x, y);
  return k < 0 ? open_ : columns_[idx(k)];
}

}  // namespace tern
