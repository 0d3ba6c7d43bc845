// LAS 1.0–1.4: airborne LiDAR with a class per point (ASPRS, "LAS Specification 1.4 – R15").
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// The points of an uncompressed LAS file, point data record formats 0–10. Positions follow by the header's scale and
/// offset, then by `frame`; classes from the low five bits (formats 0–5) or the whole byte (6–10). Points marked as
/// withheld are left out.
///
/// Hostile files are expected: everything is checked against the file's size and kMaxCloudPoints before memory is
/// taken. Errors name `file`, offset, value and limit. It fails for another signature or version, LAZ compression,
/// unknown formats, records shorter than their format, points beyond the file's end. Likewise for coordinates beyond
/// kMaxCoordinate in W. O(points).
Result<PointCloud> parse_las(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame);

}  // namespace tern
