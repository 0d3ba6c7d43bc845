// A kind of voxels: a label with all or some of its classes.
#pragma once

#include <bitset>
#include <cstddef>

#include "core/world/voxel_map.h"

namespace tern {

struct VoxelKind {
  VoxelLabel label = VoxelLabel::Unknown;
  std::bitset<256> classes;  ///< bit k: class index k of VoxelMap

  /// All voxels of a label, of every class.
  VoxelKind(VoxelLabel of) : label(of) { classes.set(); }  // NOLINT(google-explicit-constructor): a label is a kind
  VoxelKind(VoxelLabel of, const std::bitset<256>& only) : label(of), classes(only) {}

  [[nodiscard]] bool has(const VoxelMap& map, std::size_t voxel) const {
    return map.labels[voxel] == label && classes[map.classes[voxel]];
  }
};

}  // namespace tern
