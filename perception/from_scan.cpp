#include "perception/from_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace tern {
namespace {

/// Stands for `without limit`, m.
constexpr double kUnlimited = 1e4;
constexpr int kAzimuths = 360, kElevations = 180;

bool same_image(const DepthImage& a, const DepthImage& b) {
  return a.at == b.at && a.sensor_id == b.sensor_id && a.width == b.width && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.unit_m == b.unit_m && a.q_WC == b.q_WC &&
         a.sensor_position == b.sensor_position && a.range_m == b.range_m;
}

/// Returns the sensor's range, m; an Error if it measures nothing beyond `least_range_m`.
Result<double> range_of(const char* what, std::int32_t sensor, double range_m, double least_range_m) {
  const double range = range_m > 0.0 ? range_m : kUnlimited;
  if (range > least_range_m) return range;
  return fail(fmt::format("{} of sensor {}: its range of {:g} m is not beyond the least range of {:g} m", what, sensor,
                          range, least_range_m));
}

/// The depths of a whole image, m; 0: not measured.
Result<std::vector<float>> whole_image(std::span<const DepthImage> parts, int height) {
  const DepthImage& first = parts.front();
  std::vector<float> depths(idx(first.width) * idx(height), kNotMeasured);
  bool any = false;
  for (const DepthImage& part : parts) {
    if (!same_image(part, first)) {
      return fail(fmt::format("depth image of sensor {}: a part is of another image or camera", first.sensor_id));
    }
    const std::size_t begin = idx(part.first_row) * idx(part.width);
    if (part.first_row < 0 || begin + part.depths.size() > depths.size()) {
      return fail(fmt::format("depth image of sensor {}: rows from {} on do not fit into {} rows", first.sensor_id,
                              part.first_row, height));
    }
    for (std::size_t k = 0; k < part.depths.size(); ++k) {
      if (part.depths[k] <= 0) continue;
      depths[begin + k] = static_cast<float>(part.depths[k] * part.unit_m);
      any = true;
    }
  }
  if (!any) return fail(fmt::format("depth image of sensor {}: no pixel measured a depth", first.sensor_id));
  return depths;
}

/// The measured pixel of a block that is nearest to its middle; 0 if there is none.
float of_block(const std::vector<float>& depths, int width, int first_u, int first_v, int block) {
  float chosen = kNotMeasured;
  int least = std::numeric_limits<int>::max();
  for (int v = 0; v < block; ++v) {
    for (int u = 0; u < block; ++u) {
      const float depth = depths[idx((first_v + v) * width + first_u + u)];
      const int off = std::abs(2 * u - block + 1) + std::abs(2 * v - block + 1);
      if (depth <= kNotMeasured || off >= least) continue;
      chosen = depth;
      least = off;
    }
  }
  return chosen;
}

float limited(float depth, const DepthSensor& sensor) {
  if (depth < static_cast<float>(sensor.least_range_m)) return kNotMeasured;
  return std::min(depth, static_cast<float>(sensor.range_m));
}

}  // namespace

Result<DepthPicture> picture_of(std::span<const DepthImage> parts, int height, const DepthNoise& noise,
                                double least_range_m) {
  if (parts.empty()) return fail("depth image: no message");
  const DepthImage& first = parts.front();
  if (height < 1) return fail(fmt::format("depth image of sensor {}: height {} is below 1", first.sensor_id, height));
  const int block = std::min((first.width + kMostColumns - 1) / kMostColumns, height);
  const std::int64_t pixels = std::int64_t{first.width} * height;
  if (pixels > kMostImagePixels || (first.width / block) * (height / block) > kMostPicturePixels) {
    return fail(
        fmt::format("depth image of sensor {}: {} × {} pixels are too many", first.sensor_id, first.width, height));
  }
  const auto range = range_of("depth image", first.sensor_id, first.range_m, least_range_m);
  if (!range) return tl::unexpected(range.error());
  const Result<std::vector<float>> depths = whole_image(parts, height);
  if (!depths) return tl::unexpected(depths.error());

  DepthSensor sensor;
  sensor.least_range_m = least_range_m;
  sensor.range_m = *range;
  sensor.noise = noise;
  sensor.noise.block = (noise.block + block - 1) / block;
  sensor.shape.columns = first.width / block;
  sensor.shape.rows = height / block;
  sensor.shape.fx = first.fx / block;
  sensor.shape.fy = first.fy / block;
  sensor.shape.cx = (first.cx + 0.5) / block - 0.5;
  sensor.shape.cy = (first.cy + 0.5) / block - 0.5;

  DepthPicture picture(std::make_shared<RayGrid>(sensor));
  const Eigen::Vector4d& q = first.q_WC;
  picture.move_to({first.sensor_position, Eigen::Quaterniond(q[0], q[1], q[2], q[3])});
  for (int v = 0, pixel = 0; v < sensor.shape.rows; ++v) {
    for (int u = 0; u < sensor.shape.columns; ++u, ++pixel) {
      picture.depths()[pixel] = limited(of_block(*depths, first.width, u * block, v * block, block), sensor);
    }
  }
  return picture;
}

Result<DepthPicture> picture_of(std::span<const CloudScan> parts, const DepthNoise& noise, double least_range_m) {
  if (parts.empty()) return fail("point cloud: no message");
  const CloudScan& first = parts.front();
  const auto range = range_of("point cloud", first.sensor_id, first.range_m, least_range_m);
  if (!range) return tl::unexpected(range.error());
  DepthSensor sensor;
  sensor.shape =
      lidar_shape(2.0 * std::numbers::pi, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi, kAzimuths, kElevations);
  sensor.least_range_m = least_range_m;
  sensor.range_m = *range;
  sensor.noise = noise;
  DepthPicture picture(std::make_shared<RayGrid>(sensor));
  picture.move_to(looking(first.sensor_position, 0.0));
  picture.depths().setConstant(kNotMeasured);
  bool any = false;
  for (const CloudScan& part : parts) {
    if (part.at != first.at || part.sensor_id != first.sensor_id || part.sensor_position != first.sensor_position) {
      return fail(fmt::format("point cloud of sensor {}: a part is of another scan", first.sensor_id));
    }
    for (const CloudPoint& point : part.points) {
      if (!point.position.allFinite()) continue;
      const auto place = picture.place_of(first.sensor_position + point.position.cast<double>());
      if (!place) continue;
      const auto depth = limited(static_cast<float>(place->depth), sensor);
      if (depth <= kNotMeasured) continue;
      const int u = std::clamp(static_cast<int>(std::lround(place->u)), 0, kAzimuths - 1);
      const int v = std::clamp(static_cast<int>(std::lround(place->v)), 0, kElevations - 1);
      float& nearest = picture.depths()[v * kAzimuths + u];
      nearest = nearest <= kNotMeasured ? depth : std::min(nearest, depth);
      any = true;
    }
  }
  if (!any) return fail(fmt::format("point cloud of sensor {}: no point was measured", first.sensor_id));
  return picture;
}

}  // namespace tern
