// Labels voxels one after the other; the stronger label stays.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/world/voxel_map.h"

namespace tern {

class VoxelPainter {
 public:
  VoxelPainter(const VoxelGrid& grid, VoxelLabel background);

  /// The index of a class name, entered when it is new. @throws std::length_error beyond kMaxMapClasses.
  std::uint8_t class_index(const std::string& name);
  /// Labels a voxel unless it carries a label as strong or stronger. @pre index in [0, grid.voxels())
  void paint(std::int64_t index, VoxelLabel label, std::uint8_t class_index);
  /// Paints the voxels that meet `region` and for which `inside` (given the voxel's box) holds.
  void paint_if(const Box& region, VoxelLabel label, std::uint8_t class_index,
                const std::function<bool(const Box&)>& inside);

  [[nodiscard]] const VoxelGrid& grid() const { return map_.grid; }
  /// The map with its version. The painter is empty afterwards.
  VoxelMap finish();

 private:
  VoxelMap map_;
  std::vector<std::uint8_t> strength_;  ///< of what was painted; 0: background
};

}  // namespace tern
