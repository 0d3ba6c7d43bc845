// Tags whose places are known: a camera that sees one measures where the vehicle is.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/base/time.h"
#include "core/world/inertial.h"
#include "simulator/inertial/camera_frame.h"

namespace tern {

/// An entry of `simulator.vio.tags`: a printed tag (AprilTag, ArUco), recognized from all sides.
struct VisualTag {
  Vec3 position = Vec3::Zero();  ///< W, m
  double range_m = 8.0;          ///< from farther away it is not recognized
  double sigma_m = 0.02;         ///< σ(d) = sigma_m + sigma_per_m · d, per axis, at the distance d
  double sigma_per_m = 0.01;
};

/// Measures the body's position by each tag that the left camera sees: p + n, n normal with σ(d) per axis. A tag is
/// seen as a landmark is (CameraFrame::see), within its range, unless a box hides it. Deterministic from the seed and
/// frames.
class TagSight {
 public:
  TagSight(std::vector<VisualTag> tags, std::uint64_t seed) : tags_(std::move(tags)), rng_(seed) {}
  /// @param body  true position of the body, W, m
  /// @return a fix per seen tag; its sensor_id is the tag's place in the list
  std::vector<PositionFix> look(const CameraFrame& frame, const Vec3& body, UTime at);

 private:
  std::vector<VisualTag> tags_;
  Rng rng_;
};

}  // namespace tern
