// The message OBSTACLE_SIGHTINGS: boxes as a sensor with a view measures them, and what the sensor looked at.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// The visibility of one bound of a box. A bound is a measured end of the obstacle only if it is Face or Whole.
enum class BoundSight : std::uint8_t {
  Face,      ///< a face of the box, fitted to its points
  Whole,     ///< the points end here, and beyond them the sensor saw farther
  Occluded,  ///< something nearer hides the continuation
  Cut,       ///< the picture, or the sensor's range, ends here
  Touching,  ///< another surface at the same depth continues
  Unseen,    ///< the bound faces away from the sensor, and nothing of it was seen
};

/// The part of one obstacle that a sensor saw at one time, as an axis-aligned box.
struct Sighting {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();              ///< bounds of the visible part, W, m, lower ≤ upper
  Vec3 lower_sigma = Vec3::Zero(), upper_sigma = Vec3::Zero();  ///< standard deviations of the bounds, m, ≥ 0
  std::array<BoundSight, 6> bounds{};                           ///< −x, +x, −y, +y, −z, +z
  std::int32_t points = 1;                                      ///< pixels or returns on it, ≥ 1
};

enum class ViewKind : std::uint8_t {
  Pinhole,    ///< a camera: depths along the optical axis, cells equal in tan(angle)
  Spherical,  ///< a lidar: depths along the rays, cells equal in angle
};

/// The view of a sensor in one frame, and the depths in it. The sensor's frame C has x to the right, y down and z
/// forward. The azimuth is positive to the right, the elevation upwards, both from z. The field of view reaches from
/// −left to right and from −down to up.
struct SensorView {
  ViewKind kind = ViewKind::Pinhole;
  Vec3 sensor_position = Vec3::Zero();                       ///< W, m
  Eigen::Vector4d q_WC{1, 0, 0, 0};                          ///< w, x, y, z of the unit quaternion that turns C into W
  double left = 0.0, right = 0.0;                            ///< rad; Pinhole: < π/2, Spherical: ≤ π
  double up = 0.0, down = 0.0;                               ///< rad; < π/2
  double near_m = 0.0, range_m = 1.0;                        ///< smallest and largest depth that it measures, m
  double depth_sigma = 0.0, depth_sigma_per_square_m = 0.0;  ///< σ(z) = depth_sigma + depth_sigma_per_square_m·z², m
  double unit_m = 0.01;                                      ///< of the depths, m, > 0
  std::int32_t rows = 0, columns = 0;                        ///< cells; rows from the top, columns from the left
  std::vector<std::int16_t> depths;                          ///< see kFarDepth; rows × columns, row by row
};
/// A cell's depth is the smallest depth measured in it, in units, rounded down. kBlindDepth: part of the cell was not
/// measured. kFarDepth: nothing was within the range.
inline constexpr std::int16_t kBlindDepth = 0, kFarDepth = 32'767;

/// OBSTACLE_SIGHTINGS: one frame of one sensor. A sensor that sends it for a frame does not send
/// OBSTACLE_OBSERVATIONS for this frame.
struct SightingSet {
  Header header;
  UTime at;  ///< when the sensor measured, latency not included, vehicle's clock
  std::int32_t sensor_id = 0;
  std::int32_t left_out = 0;  ///< sightings that did not fit
  SensorView view;
  std::vector<Sighting> sightings;
};
inline constexpr int kMaxSightings = 400;
inline constexpr int kMaxViewCells = 4'096;

}  // namespace tern
