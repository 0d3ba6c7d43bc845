// PLY point clouds with a class per vertex (Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// The vertices of an ASCII, little-endian or big-endian binary PLY file. Of each vertex x, y, z are read, and the
/// class: the first of the properties `label`, `class`, `classification`, `class_id`, `semantic`, `scalar_Label`,
/// `scalar_Classification`. A file without any of them gives class 0. Other scalar properties are passed over; elements
/// after the vertices are not looked at.
///
/// Errors name `file`, offset, value and limit. It fails for no PLY, a header beyond kMaxPlyHeader bytes, elements
/// before the vertices, list properties in a vertex, unknown types, properties given twice. It also fails for more
/// vertices than kMaxCloudPoints or than the file has, and coordinates beyond kMaxCoordinate in W. Text must be a
/// number, and a class an integer in [0, 255]. O(bytes).
Result<PointCloud> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame);

inline constexpr std::size_t kMaxPlyHeader = 65'536;
inline constexpr std::size_t kMaxPlyProperties = 256;

}  // namespace tern
