// A map that scans change in flight: what a ray hits becomes occupied, what it passes becomes free.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"
#include "semantic_mapper/sources/octomap.h"
#include "semantic_mapper/sources/point_cloud.h"
#include "semantic_mapper/voxel_map/map_builder.h"

namespace tern {

/// The points that one sensor measured at one time.
struct Scan {
  Vec3 sensor = Vec3::Zero();  ///< W, m
  double range = 0.0;          ///< points farther away are free space up to the range, m; 0: unlimited
  bool has_classes = false;
  PointCloud points;  ///< W; all finite
};

/// Which points of a scan count.
struct ScanRange {
  double min = 0.3;   ///< nearer points are the vehicle's own parts and are ignored, m, ≥ 0
  double max = 20.0;  ///< farther points are free space up to here, m, > min
};

/// Occupancy by log-odds, after OctoMap (Hornung et al. 2013), over the map of the files.
///
/// | a voxel                          | change of its log-odds, per scan |
/// |----------------------------------|----------------------------------|
/// | with a point in it               | +0.85, probability 0.7           |
/// | that rays pass, without a point  | −0.4, probability 0.4            |
///
/// They stay within −2 and 3.5, so a voxel that was occupied for long is free after nine scans through it. From 0 on a
/// voxel is occupied; it gets the label of its last class. A voxel that no ray met is as the files say, or the newest
/// OctoMap. Where several say something the strongest label is kept: occupied > repulsive > attractive > free >
/// unknown. So scans never free what a file, a region or the OctoMap says is occupied.
class LiveMap {
 public:
  /// @param base  the map of the files and regions; its grid stays
  /// @param classes  the meanings of classes. Points of a class without a meaning mark nothing; the space before them
  ///   is free.
  /// @throws std::invalid_argument if the map has more than kMaxLiveVoxels
  /// @throws std::length_error if it has more than kMaxMapClasses with these
  LiveMap(VoxelMap base, const ClassMeanings& classes, const ScanRange& range);

  /// Adds a scan. Points of a scan without classes are occupied, of class "unlabelled". O(points · range/resolution).
  /// @return the number of points that count, those beyond the range included. 0: the scan says nothing
  int add(const Scan& scan);
  /// Sets the OctoMap of another program, in place of the one before. O(voxels + leaves).
  /// @return false if it marks no voxel. It then changes nothing.
  [[nodiscard]] bool set_octomap(const OctoMapFile& octomap);

  /// Frees the unseen voxels within kStartMargin voxels of the box around the body at p. The vehicle starts there, and
  /// its sensors may not see above and below it. This is its start from then on.
  void free_start(const Body& body, const Vec3& p);
  /// Returns the map as it is now. Voxels in which the body at p stands are free, unless a file or a region says that
  /// they are occupied. Within kStartMargin voxels of the start these are voxels_stood_in, elsewhere voxels_met.
  /// O(voxels).
  [[nodiscard]] VoxelMap map(const Body& body, const Vec3& p) const;
  [[nodiscard]] const VoxelGrid& grid() const { return base_.grid; }

 private:
  /// The label and class index of the points of a class.
  struct Meaning {
    VoxelLabel label = VoxelLabel::Unknown;  ///< Unknown: marks nothing
    std::uint8_t class_index = 0;
  };
  void hit(std::int64_t voxel, const Meaning& meaning);
  void pass(std::int64_t voxel);

  VoxelMap base_;
  std::array<Meaning, 256> meanings_;
  Meaning unlabelled_;
  ScanRange range_;
  std::vector<std::int8_t> log_odds_;  // in steps; kUnseen: no ray met the voxel
  std::vector<Meaning> last_;          // of the last point in a voxel
  std::vector<VoxelLabel> octomap_;    // of the newest OctoMap; empty: none has come
  std::vector<std::uint32_t> met_by_;  // the scan that met a voxel last: 2 n by a ray, 2 n + 1 by a point
  std::uint32_t scans_ = 0;
  std::optional<Vec3> start_;  // W, m
};

/// Unseen space this near to the vehicle is free at its start, voxels.
inline constexpr double kStartMargin = 2.0;
/// The largest live map, voxels: a voxel takes ten bytes, and each new version of the map is sent whole.
inline constexpr std::int64_t kMaxLiveVoxels = 20'000'000;

}  // namespace tern
