// Reader of LAS 1.0–1.4: airborne LiDAR with a class per point (ASPRS, "LAS Specification 1.4 – R15").
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// Returns whether these bytes begin a LAS file whose points are compressed (LAZ).
bool is_compressed_las(std::span<const std::uint8_t> bytes);

/// Returns the points of an uncompressed LAS file with point data record format 0–10. O(points).
///
/// Positions are computed by the header's scale and offset, then by `frame`. The class is in the low five bits (formats
/// 0–5) or in the whole byte (6–10). Withheld points are left out. Points that cannot be used are left out and counted
/// (CloudFile). If the 64-bit count of version 1.4 is 0, the legacy count is used.
///
/// Files may be hostile: all sizes are checked against the file's size and kMaxCloudPoints before memory is allocated.
/// An Error names `file`, offset, value and limit. Errors are:
///
/// * another signature or version, LAZ compression, an unknown format;
/// * records shorter than their format, or points beyond the end of the file.
Result<CloudFile> parse_las(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame);

}  // namespace tern
