// From a depth picture to sightings: clusters, corner fits, and the visibility of each of six bounds.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/types.h"
#include "core/world/sighting.h"
#include "perception/depth_picture.h"

namespace tern {

/// A cluster of fewer pixels is ignored.
inline constexpr int kLeastPixels = 6;
/// A cluster is split at most this often (step 4 of Detector).
inline constexpr int kMostPeelings = 4;
/// Points nearer than this to known surroundings count as theirs, m: the height of what lies on a floor.
inline constexpr double kSurroundingsMargin = 0.1;

/// Known things at rest. Points on them are removed before clustering.
struct KnownSurroundings {
  std::optional<double> ground_z;  ///< W, m
  std::span<const Box> boxes{};    ///< walls and occupied voxels of the map, W
};

/// Finds objects in depth pictures. The result depends on one picture alone; only memory is used again for the next.
///
/// 1. Points within kSurroundingsMargin + 3σ of the ground or of a known box are removed.
/// 2. Neighbouring pixels whose depths continue each other are one cluster (clusters.h).
/// 3. A corner, up to three faces that meet, is fitted to the depths of a cluster (corner_fit.h).
/// 4. Rays that do not fit are split off, if they are at least kLeastPixels and 8 % of the cluster. They run through
///    steps 2 to 5 by themselves.
/// 5. Bounds come from the faces, and their flags from the pixels around the cluster (bounds.h).
///
/// Objects are taken to be axis-aligned boxes. A cluster to which no face fits becomes the box of its points, with
/// every bound Occluded.
class Detector {
 public:
  Detector();
  ~Detector();
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;

  /// Returns the sightings of a picture in the order of their first pixels; those split off in step 4 come last. Valid
  /// until the next call.
  const std::vector<Sighting>& detect(const DepthPicture& picture, const KnownSurroundings& surroundings);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

/// Makes the frame of a picture: its sightings and its view (view.h). Of more than kMaxSightings, those with the most
/// points are kept; left_out counts the others. The header is empty.
SightingSet frame_of(const DepthPicture& picture, const std::vector<Sighting>& sightings, UTime at, int sensor_id);

}  // namespace tern
