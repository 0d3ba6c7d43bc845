// From a depth picture to boxes: clusters, corner fits, and how each of six bounds was seen.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/types.h"
#include "perception/depth_picture.h"

namespace tern {

/// The surroundings of a bound of a box.
enum class BoundSeen : std::uint8_t {
  Whole,     ///< the box ends there: what lies beyond is farther, or empty
  Occluded,  ///< something nearer hides what lies beyond, or the box hides it itself
  Cut,       ///< the picture ends there
  Touching,  ///< something at the same depth goes on: the ground, a wall, another box
};

/// The visible part of one object as an axis-aligned box. A bound that is Whole is measured with its standard
/// deviation. At any other bound the object is known to reach at least this far.
struct SeenBox {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();              ///< W, m
  Vec3 sigma_lower = Vec3::Zero(), sigma_upper = Vec3::Zero();  ///< of the bounds, m, > 0
  std::array<BoundSeen, 3> seen_lower{}, seen_upper{};
  int pixels = 0;  ///< ≥ kLeastPixels
};

/// Fewer pixels are no object.
inline constexpr int kLeastPixels = 6;

/// Known things at rest. Points on them are removed before clustering.
struct KnownSurroundings {
  bool has_ground = false;
  double ground_z = 0.0;         ///< W, m
  std::span<const Box> boxes{};  ///< walls and occupied voxels of the map, W
};

/// Finds boxes in depth pictures. It keeps its memory from picture to picture, and is a function of the picture: the
/// same picture gives the same boxes.
///
/// 1. Points within 0.1 m + 3σ of the ground or of a known box are removed.
/// 2. Neighbouring pixels whose depths differ by less than 0.25 m + 2√2 σ(z) are one cluster.
/// 3. A corner, up to three faces that meet, is fitted to a cluster's depths (corner_fit.h).
/// 4. Points that do not fit (3σ + 5 cm) are peeled off, and make clusters of their own, at most kPeelings times.
/// 5. Bounds are taken from the fitted faces. Their flags come from the pixels around the cluster.
///
/// Source: Tern's measurements in docs/lab. True boxes are taken to be axis-aligned.
class Detector {
 public:
  Detector();
  ~Detector();
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;

  /// Returns the boxes of a picture, by their first pixel. Valid until the next call.
  const std::vector<SeenBox>& detect(const DepthPicture& picture, const KnownSurroundings& known);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace tern
