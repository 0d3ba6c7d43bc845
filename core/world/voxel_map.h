// The metric-semantic map M (paper §2): labelled voxels, and the message SEMANTIC_MAP that carries it in chunks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The label of a voxel.
enum class VoxelLabel : std::uint8_t { Unknown = 0, Free = 1, Occupied = 2, Attractive = 3, Repulsive = 4 };
inline constexpr int kVoxelLabels = 5;

/// A grid of voxels. Voxel (i, j, k) is the cube with the lower corner origin + resolution·(i, j, k).
struct VoxelGrid {
  Vec3 origin = Vec3::Zero();                      ///< lower corner of the grid, W, m
  double resolution = 0.25;                        ///< side of a voxel, m, > 0
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< voxels per axis, ≥ 0

  [[nodiscard]] std::int64_t voxels() const { return static_cast<std::int64_t>(size.x()) * size.y() * size.z(); }
  /// Returns the index of a voxel: x runs fastest, then y, then z.
  [[nodiscard]] std::int64_t index(const Eigen::Vector3i& v) const {
    return v.x() + static_cast<std::int64_t>(size.x()) * (v.y() + static_cast<std::int64_t>(size.y()) * v.z());
  }
  /// Returns the voxel with an index.
  [[nodiscard]] Eigen::Vector3i cell(std::int64_t index) const;
  [[nodiscard]] bool contains(const Eigen::Vector3i& v) const {
    return v.x() >= 0 && v.x() < size.x() && v.y() >= 0 && v.y() < size.y() && v.z() >= 0 && v.z() < size.z();
  }
  /// Returns the voxel that contains p (W, m); it may lie outside the grid.
  [[nodiscard]] Eigen::Vector3i cell_of(const Vec3& p) const;
  /// Returns the lower corner of a voxel, W, m.
  [[nodiscard]] Vec3 corner(const Eigen::Vector3i& v) const {
    return {origin.x() + resolution * v.x(), origin.y() + resolution * v.y(), origin.z() + resolution * v.z()};
  }
  [[nodiscard]] Vec3 centre(const Eigen::Vector3i& v) const {
    return {origin.x() + resolution * (v.x() + 0.5), origin.y() + resolution * (v.y() + 0.5),
            origin.z() + resolution * (v.z() + 0.5)};
  }
  [[nodiscard]] Box box(const Eigen::Vector3i& v) const {
    const Vec3 low = corner(v);
    return {low, Vec3(low.x() + resolution, low.y() + resolution, low.z() + resolution)};
  }
  [[nodiscard]] Box bounds() const { return {origin, corner(size)}; }
};

/// A labelled grid. A map does not change once it is made; its digest names it.
struct VoxelMap {
  VoxelGrid grid;
  std::vector<VoxelLabel> labels;        ///< a label per voxel, by grid.index()
  std::vector<std::uint8_t> classes;     ///< an index into class_names per voxel; 0: no class
  std::vector<std::string> class_names;  ///< class_names[0] is ""
  std::uint64_t version = 0;             ///< compute_version()

  /// Returns the digest of grid, labels, classes and class names; never 0.
  [[nodiscard]] std::uint64_t compute_version() const;
};

/// Consecutive voxels with equal label and class.
struct VoxelRun {
  VoxelLabel label = VoxelLabel::Unknown;
  std::uint8_t class_index = 0;
  std::int32_t length = 0;  ///< ≥ 1
};

/// SEMANTIC_MAP: one chunk of a map. Chunks are sent in rotation, so a process that starts late receives all of them.
struct MapChunk {
  Header header;
  std::uint64_t version = 0;
  VoxelGrid grid;
  std::vector<std::string> class_names;
  std::int32_t index = 0, count = 1;  ///< number of this chunk, 0 … count − 1; count ≤ kMaxMapChunks
  std::int64_t first_voxel = 0;       ///< index of the first voxel of the runs
  std::vector<VoxelRun> runs;
};
inline constexpr int kMaxMapChunks = 4096;
inline constexpr int kMaxRunsPerChunk = 8000;
inline constexpr std::int64_t kMaxVoxels = 200'000'000;

/// Returns the chunks of a map, with empty headers. An empty grid gives one chunk.
std::vector<MapChunk> to_chunks(const VoxelMap& map);

/// After this silence the sender of maps is considered gone. (A map of one chunk is sent once a second.)
inline constexpr Duration kMapSilence{2'500'000};

/// Assembles a map from chunks that arrive in any order.
///
/// | chunk                                                   | effect                                          |
/// |---------------------------------------------------------|-------------------------------------------------|
/// | of another sender, less than kMapSilence after the last | ignored, as mixed chunks would complete no map  |
/// | of another sender, later                                | the unfinished map is dropped; a new one begins |
/// | of the version that was completed last, or a repeated one | ignored                                       |
/// | of another version                                      | the unfinished map is dropped; a new one begins |
/// | inconsistent with the unfinished map                    | an Error; the unfinished map is dropped         |
class MapAssembler {
 public:
  /// Adds a chunk. Returns true if it completes the map, which take() then returns. An Error names the inconsistency:
  /// of the grid, the class names, the number of chunks, the runs, or the digest of the complete map.
  Result<bool> add(const MapChunk& chunk);
  /// Returns the complete map and forgets it. @pre add() has returned true
  [[nodiscard]] VoxelMap take();

 private:
  VoxelMap map_;
  std::int64_t epoch_us_ = 0;  ///< epoch of the sender whose chunks are used
  UTime last_sent_;            ///< when it sent its newest chunk, by its clock
  std::uint64_t finished_version_ = 0;
  std::vector<bool> have_;
  int missing_ = 0;
};

}  // namespace tern
