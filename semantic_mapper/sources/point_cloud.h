// Labelled point clouds as values, and where they lie in W.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"

namespace tern {

/// A point and its class number: ASPRS's for LAS (class_names.h), the file's own for PLY.
struct LabelledPoint {
  Vec3 position = Vec3::Zero();  ///< W, m
  std::uint8_t class_number = 0;
};
using PointCloud = std::vector<LabelledPoint>;

/// How a file's coordinates become W's: p_W = (p_file − origin) · metres_per_unit. Surveys count from far away, in
/// metres or feet, and do not always say which.
struct PointFrame {
  Vec3 origin = Vec3::Zero();    ///< file's units
  double metres_per_unit = 1.0;  ///< > 0

  /// @return nullopt if the result is not finite or farther than kMaxCoordinate from W's origin on an axis.
  [[nodiscard]] std::optional<Vec3> to_world(const Vec3& p_file) const;
};

/// No file may claim more points (memory: 32 bytes each).
inline constexpr std::int64_t kMaxCloudPoints = 50'000'000;

/// "file, offset 107: number of points 99 is more than the limit 4".
tl::unexpected<Error> bad_file(const std::string& file, std::size_t offset, const std::string& what);

}  // namespace tern
