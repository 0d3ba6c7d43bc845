#include "semantic_mapper/voxel_map/voxel_painter.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/wire/message_limits.h"
#include "semantic_mapper/voxel_map/standing_place.h"

namespace tern {

std::uint8_t strength_of(VoxelLabel label) {
  switch (label) {
    case VoxelLabel::Unknown: return 1;
    case VoxelLabel::Free: return 2;
    case VoxelLabel::Attractive: return 3;
    case VoxelLabel::Repulsive: return 4;
    case VoxelLabel::Occupied: return 5;
  }
  return 0;
}

std::uint8_t index_of_class(const std::string& name, std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = idx(found - names.begin());
  if (found == names.end()) {
    if (names.size() == kMaxMapClasses) throw std::length_error("more classes than a map can name");
    names.push_back(name);
  }
  return static_cast<std::uint8_t>(index);
}

VoxelPainter::VoxelPainter(const VoxelGrid& grid, VoxelLabel background) {
  const auto n = static_cast<std::size_t>(grid.voxels());
  map_.grid = grid;
  map_.labels.assign(n, background);
  map_.classes.assign(n, 0);
  map_.class_names = {""};
  strength_.assign(n, 0);
}

void VoxelPainter::paint(std::int64_t index, VoxelLabel label, std::uint8_t class_index) {
  const auto i = idx(index);
  const std::uint8_t strength = strength_of(label);
  if (strength <= strength_[i]) return;
  strength_[i] = strength;
  map_.labels[i] = label;
  map_.classes[i] = class_index;
}

void VoxelPainter::paint_if(const Box& region, VoxelLabel label, std::uint8_t class_index,
                            const std::function<bool(const Box&)>& inside) {
  const VoxelGrid& g = map_.grid;
  const Box cut = region.intersection(g.bounds());
  if (cut.isEmpty()) return;
  const Eigen::Vector3i last = g.size - Eigen::Vector3i::Ones();
  const Eigen::Vector3i low = g.cell_of(cut.min()).cwiseMax(0).cwiseMin(last);
  const Eigen::Vector3i high = g.cell_of(cut.max()).cwiseMax(0).cwiseMin(last);
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        if (inside(g.box({x, y, z}))) paint(g.index({x, y, z}), label, class_index);
      }
    }
  }
}

std::int64_t VoxelPainter::free_standing_place(const Body& body, const Vec3& p) {
  const std::vector<std::int64_t> voxels = voxels_stood_in(map_.grid, map_.labels, body, p);
  for (const std::int64_t voxel : voxels) {
    map_.labels[idx(voxel)] = VoxelLabel::Free;
    map_.classes[idx(voxel)] = 0;
  }
  return std::ssize(voxels);
}

VoxelMap VoxelPainter::finish() {
  map_.version = map_.compute_version();
  strength_.clear();
  return std::exchange(map_, {});
}

}  // namespace tern
