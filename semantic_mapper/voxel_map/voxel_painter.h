// Labels voxels one by one; the stronger label is kept.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"

namespace tern {

/// The class of occupied voxels whose source has no labels.
inline constexpr const char* kUnlabelled = "unlabelled";

/// Returns the strength of a label: occupied > repulsive > attractive > free > unknown > 0.
std::uint8_t strength_of(VoxelLabel label);

/// Returns the index of a class name and adds the name if it is new.
/// @throws std::length_error if there would be more than kMaxMapClasses
std::uint8_t index_of_class(const std::string& name, std::vector<std::string>& names);

/// Builds a map voxel by voxel.
class VoxelPainter {
 public:
  VoxelPainter(const VoxelGrid& grid, VoxelLabel background);

  /// Returns index_of_class() among the map's names.
  std::uint8_t class_index(const std::string& name) { return index_of_class(name, map_.class_names); }
  /// Labels a voxel unless it has an equal or a stronger label already. @pre index in [0, grid().voxels())
  void paint(std::int64_t index, VoxelLabel label, std::uint8_t class_index);
  /// Labels the voxels that overlap `region` and for whose box `inside` returns true.
  void paint_if(const Box& region, VoxelLabel label, std::uint8_t class_index,
                const std::function<bool(const Box&)>& inside);

  /// Frees the voxels in which the body at p stands (voxels_stood_in). @return how many
  std::int64_t free_standing_place(const Body& body, const Vec3& p);

  [[nodiscard]] const VoxelGrid& grid() const { return map_.grid; }
  /// Returns the map with its version. The painter is empty afterwards.
  VoxelMap finish();

 private:
  VoxelMap map_;
  std::vector<std::uint8_t> strength_;  ///< strength of each voxel's label; 0: background
};

}  // namespace tern
