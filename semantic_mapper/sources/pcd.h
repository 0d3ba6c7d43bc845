// Reader of PCD point clouds, the format of the Point Cloud Library (pointclouds.org, "The PCD file format", 0.7).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// Reads the points of a PCD file with DATA ascii, binary or binary_compressed: x, y, z and the class of each.
///
/// The class is the field `label`; if that is empty, one with a usual name (PointColumns::find). A file without one has
/// `has_labels` false. Other fields are ignored. NaN marks an invalid point; points that cannot be used are left out
/// and counted (CloudFile). The points are taken as they are, as PCL's loader takes them: a VIEWPOINT
/// other than the origin is a warning of the CloudFile. Binary numbers are little-endian.
///
/// Errors name `file`, offset, value and limit. It fails for:
///  - a file that is no PCD, or whose header is longer than kMaxPcdHeader bytes or has more than kMaxPcdFields numbers
///    per point;
///  - FIELDS, SIZE, TYPE and COUNT of different lengths, and types that do not exist;
///  - a field `label` that the file does not have: the error lists the fields;
///  - POINTS that is not WIDTH × HEIGHT, more points than kMaxCloudPoints or than the file has;
///  - text instead of a number, and compressed data of another size than the points.
///
/// O(bytes).
Result<CloudFile> parse_pcd(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame,
                            const std::string& label = "");

inline constexpr std::size_t kMaxPcdHeader = 65'536;
inline constexpr std::size_t kMaxPcdFields = 1'024;

}  // namespace tern
