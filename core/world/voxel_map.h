// The metric-semantic map M (paper §2): labelled voxels, and the chunks in which it travels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/world/header.h"

namespace tern {

enum class VoxelLabel : std::uint8_t { Unknown = 0, Free = 1, Occupied = 2, Attractive = 3, Repulsive = 4 };
inline constexpr int kVoxelLabels = 5;

/// The grid's frame: voxel (i, j, k) is the cube from origin + resolution·(i, j, k), side `resolution`.
struct VoxelGrid {
  Vec3 origin = Vec3::Zero();                      ///< the least corner, W, m
  double resolution = 0.25;                        ///< m, > 0
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< voxels per axis, ≥ 0

  [[nodiscard]] std::int64_t voxels() const { return static_cast<std::int64_t>(size.x()) * size.y() * size.z(); }
  /// x runs fastest, then y, then z.
  [[nodiscard]] std::int64_t index(const Eigen::Vector3i& v) const {
    return v.x() + static_cast<std::int64_t>(size.x()) * (v.y() + static_cast<std::int64_t>(size.y()) * v.z());
  }
  [[nodiscard]] Eigen::Vector3i cell(std::int64_t index) const;
  [[nodiscard]] bool contains(const Eigen::Vector3i& v) const {
    return (v.array() >= 0).all() && (v.array() < size.array()).all();
  }
  /// The voxel that holds p (may lie outside the grid).
  [[nodiscard]] Eigen::Vector3i cell_of(const Vec3& p) const;
  [[nodiscard]] Vec3 centre(const Eigen::Vector3i& v) const {
    return origin + resolution * (v.cast<double>() + Vec3::Constant(0.5));
  }
  [[nodiscard]] Box box(const Eigen::Vector3i& v) const {
    const Vec3 low = origin + resolution * v.cast<double>();
    return {low, low + Vec3::Constant(resolution)};
  }
  [[nodiscard]] Box bounds() const { return {origin, origin + resolution * size.cast<double>()}; }
};

/// Labels and classes of every voxel. Immutable once made; named by its digest.
struct VoxelMap {
  VoxelGrid grid;
  std::vector<VoxelLabel> labels;        ///< grid.voxels() entries, by grid.index
  std::vector<std::uint8_t> classes;     ///< same size; index into class_names, 0 = none
  std::vector<std::string> class_names;  ///< class_names[0] = "" (no class)
  std::uint64_t version = 0;             ///< compute_version()

  /// Digest of everything above; never 0.
  [[nodiscard]] std::uint64_t compute_version() const;
};

/// A run of equal voxels.
struct VoxelRun {
  VoxelLabel label = VoxelLabel::Unknown;
  std::uint8_t class_index = 0;
  std::int32_t length = 0;  ///< ≥ 1
};

/// SEMANTIC_MAP: one chunk of a map; chunks are sent in rotation, so that a late joiner gets them all.
struct MapChunk {
  Header header;
  std::uint64_t version = 0;
  VoxelGrid grid;
  std::vector<std::string> class_names;
  std::int32_t index = 0, count = 1;  ///< this chunk of so many, count ≤ kMaxMapChunks
  std::int64_t first_voxel = 0;       ///< where this chunk's runs begin
  std::vector<VoxelRun> runs;
};
inline constexpr int kMaxMapChunks = 4096;
inline constexpr int kMaxRunsPerChunk = 8000;
inline constexpr std::int64_t kMaxVoxels = 200'000'000;

/// Cuts a map into chunks (header empty). At least one chunk, even for an empty grid.
std::vector<MapChunk> to_chunks(const VoxelMap& map);

/// A sender of maps that has sent nothing for so long has ended: a map of one chunk comes once a second.
inline constexpr Duration kMapSilence{2'500'000};

/// Collects chunks in any order, of any version; a newer version (one not seen in progress) replaces an unfinished one.
/// Of two senders the one heard first is listened to until it has sent nothing for kMapSilence. Chunks of both in turn
/// would complete neither's map.
class MapAssembler {
 public:
  /// Takes a chunk. @return true when it completed a map, which `take` then gives. What another sender sends beside
  /// the one that is listened to is passed over.
  /// An inconsistent chunk (other grid, overlapping runs, wrong digest at the end) is an Error and discards that
  /// version.
  Result<bool> add(const MapChunk& chunk);
  [[nodiscard]] VoxelMap take();

 private:
  VoxelMap map_;
  std::int64_t epoch_us_ = 0;  ///< of the sender that is listened to
  UTime heard_;                ///< when it sent its newest chunk, its clock
  std::uint64_t finished_version_ = 0;
  std::vector<bool> have_;
  int missing_ = 0;
};

}  // namespace tern
