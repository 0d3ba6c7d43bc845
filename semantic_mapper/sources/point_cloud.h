// Labelled point clouds as values, and their position in W.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"

namespace tern {

/// A point and its class number: an ASPRS class in LAS files (class_names.h), the file's own number in PLY files.
struct LabelledPoint {
  Vec3 position = Vec3::Zero();  ///< W, m
  std::uint8_t class_number = 0;
};
using PointCloud = std::vector<LabelledPoint>;

/// The transform from a file's coordinates to W: p_W = (p_file − origin) · metres_per_unit. Surveys use a distant
/// origin and metres or feet, and do not always say which.
struct PointFrame {
  Vec3 origin = Vec3::Zero();    ///< in the file's units
  double metres_per_unit = 1.0;  ///< > 0

  /// Returns a point in W; nullopt if a coordinate of the result is not finite or beyond ±kMaxCoordinate.
  [[nodiscard]] std::optional<Vec3> to_world(const Vec3& p_file) const;
};

/// The largest number of points of a file; a point takes 32 bytes of memory.
inline constexpr std::int64_t kMaxCloudPoints = 50'000'000;

/// Returns an Error such as "file, offset 107: number of points 99 is more than the limit 4".
tl::unexpected<Error> bad_file(const std::string& file, std::size_t offset, const std::string& what);

}  // namespace tern
