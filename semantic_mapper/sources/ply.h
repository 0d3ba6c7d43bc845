// Reader of PLY point clouds with a class per vertex (Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// Reads the vertices of an ASCII, little-endian or big-endian binary PLY file: x, y, z and the class of each.
///
/// The class is the property `label`; if that is empty, one with a usual name (PointColumns::find). A file without a
/// class property has `has_labels` false. Other scalar properties and the elements after the vertices are ignored.
/// Vertices that cannot be used are left out and counted (CloudFile).
///
/// Errors name `file`, offset, value and limit. It fails for:
///  - a file that is no PLY, or whose header is longer than kMaxPlyHeader bytes;
///  - elements before the vertices, list properties in a vertex, unknown types, properties given twice;
///  - a property `label` that the file does not have: the error lists the properties;
///  - more vertices than kMaxCloudPoints or than the file has, or text instead of a number.
///
/// O(bytes).
Result<CloudFile> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame,
                            const std::string& label = "");

inline constexpr std::size_t kMaxPlyHeader = 65'536;
inline constexpr std::size_t kMaxPlyProperties = 256;

}  // namespace tern
