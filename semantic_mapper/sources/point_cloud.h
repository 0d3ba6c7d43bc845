// Labelled point clouds as values, and their position in W.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"

namespace tern {

/// A point and its class number: an ASPRS class in LAS files (class_names.h), the file's own number in others.
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

/// A file's points, and how many it holds that cannot be used.
struct CloudFile {
  PointCloud points;
  std::int64_t not_finite = 0;          ///< points with a coordinate that is NaN or infinite, left out
  std::int64_t too_far = 0;             ///< points beyond kMaxCoordinate in W, left out
  Vec3 first_too_far = Vec3::Zero();    ///< the first of them, in the file's coordinates
  std::int64_t not_a_class = 0;         ///< points whose label is not an integer in [0, 255], left out
  bool has_labels = true;               ///< false: the file has no property for the class, and every class is 0
  std::vector<std::string> properties;  ///< names of a point's properties in file order; empty for LAS
  std::string warning;                  ///< a fact that may make the points wrong; "" if there is none
  double spacing = 0.0;  ///< distance of neighbouring numbers at the largest float32 coordinate, m; 0 without float32

  /// Adds a point or counts why it is left out. @param label  the class number as the file has it
  void add(const Vec3& p_file, const PointFrame& frame, double label);
};

/// The largest number of points of a file; a point takes 32 bytes of memory.
inline constexpr std::int64_t kMaxCloudPoints = 50'000'000;

/// Returns "x, y, z, red" of these names as plain text; beyond 200 characters the rest is cut.
std::string listed(const std::vector<std::string>& names);

/// Returns an Error such as "file, offset 107: number of points 99 is more than the limit 4". `what` may quote bytes of
/// the file: the Error is plain text, so it can be sent.
tl::unexpected<Error> bad_file(const std::string& file, std::size_t offset, const std::string& what);

}  // namespace tern
