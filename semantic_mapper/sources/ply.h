// Reader of PLY point clouds with a class per vertex (Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// Returns the vertices of an ASCII or a little-endian or big-endian binary PLY file. O(bytes).
///
/// The properties x, y, z and the class are read. The class is the first of the properties `label`, `class`,
/// `classification`, `class_id`, `semantic`, `scalar_Label`, `scalar_Classification`; without any of them it is 0.
/// Other scalar properties, and elements after the vertices, are ignored.
///
/// An Error names `file`, offset, value and limit. Errors are:
///
/// * another format, or a header of more than kMaxPlyHeader bytes;
/// * elements before the vertices, list properties in a vertex, unknown types, a property given twice;
/// * more vertices than kMaxCloudPoints, or than the file holds;
/// * text that is no number, a class outside [0, 255] or with a fraction, coordinates beyond kMaxCoordinate in W.
Result<PointCloud> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame);

inline constexpr std::size_t kMaxPlyHeader = 65'536;
inline constexpr std::size_t kMaxPlyProperties = 256;

}  // namespace tern
