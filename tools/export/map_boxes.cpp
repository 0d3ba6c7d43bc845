#include "tools/export/map_boxes.h"

namespace tern::exporting {
namespace {

class Grower {
 public:
  explicit Grower(const VoxelMap& map) : map_(map), taken_(map.labels.size(), false) {}

  [[nodiscard]] bool is_new(std::size_t k) const { return map_.labels[k] >= VoxelLabel::Occupied && !taken_[k]; }

  MapBox grow(std::size_t from) {
    MapBox box{map_.labels[from], map_.classes[from], {}, {}};
    box.low = box.high = map_.grid.cell(static_cast<std::int64_t>(from));
    for (int axis = 0; axis < 3; ++axis) {
      while (grows(box, axis)) ++box.high[axis];
    }
    each(box.low, box.high, [&](std::size_t k) {
      taken_[k] = true;
      return true;
    });
    return box;
  }

 private:
  /// Calls f for the voxels between two corners until it says false. @return whether it never did
  template <class F>
  bool each(const Eigen::Vector3i& low, const Eigen::Vector3i& high, F f) const {
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          if (!f(static_cast<std::size_t>(map_.grid.index({x, y, z})))) return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool grows(const MapBox& box, int axis) const {
    Eigen::Vector3i low = box.low, high = box.high;
    low[axis] = ++high[axis];
    if (!map_.grid.contains(high)) return false;
    return each(low, high, [&](std::size_t k) {
      return !taken_[k] && map_.labels[k] == box.label && map_.classes[k] == box.class_index;
    });
  }

  const VoxelMap& map_;
  std::vector<bool> taken_;
};

}  // namespace

std::vector<MapBox> map_boxes(const VoxelMap& map) {
  std::vector<MapBox> boxes;
  Grower grower(map);
  for (std::size_t k = 0; k < map.labels.size(); ++k) {
    if (grower.is_new(k)) boxes.push_back(grower.grow(k));
  }
  return boxes;
}

}  // namespace tern::exporting
