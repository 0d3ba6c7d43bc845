// Reader of OctoMap files (Hornung et al., "OctoMap: An Efficient Probabilistic 3D Mapping Framework", 2013).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// A leaf of the octree: a cube of known space. Space in no leaf is unknown.
struct OctoLeaf {
  std::array<std::int32_t, 3> low{};  ///< lower corner, in voxels of the file, −2¹⁵ … 2¹⁵ − 1
  std::int32_t side = 1;              ///< voxels, a power of two
  bool is_occupied = false;           ///< else it is free
};

/// The known space of an OctoMap.
struct OctoMapFile {
  Vec3 origin = Vec3::Zero();  ///< of the file's coordinates, W, m
  double resolution = 0.0;     ///< side of a voxel of the file, m, > 0
  std::vector<OctoLeaf> leaves;
  std::int64_t too_far = 0;  ///< leaves beyond kMaxCoordinate in W, left out

  /// Returns a leaf's cube, W, m.
  [[nodiscard]] Box box(const OctoLeaf& leaf) const;
};

/// Reads the leaves of a `.bt` file (occupied and free) or of an `.ot` file (log-odds), of an OcTree or a ColorOcTree.
/// A leaf of an `.ot` file is occupied from log-odds 0, probability 0.5, as OctoMap's default is.
///
/// Errors name `file`, offset, value and limit. It fails for:
///  - a file that does not begin as an OctoMap does, or whose header is longer than kMaxOctoMapHeader bytes;
///  - another kind of tree, a resolution that is missing or not positive, infinite log-odds or NaN;
///  - nodes deeper than the 16 levels of an OctoMap, a file that ends within the tree;
///  - more than kMaxOctoLeaves leaves.
///
/// O(bytes).
Result<OctoMapFile> parse_octomap(std::span<const std::uint8_t> bytes, const std::string& file,
                                  const PointFrame& frame);

inline constexpr std::size_t kMaxOctoMapHeader = 65'536;
inline constexpr std::size_t kMaxOctoLeaves = 50'000'000;

}  // namespace tern
