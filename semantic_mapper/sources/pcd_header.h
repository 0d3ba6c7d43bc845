// The header of a PCD file: the fields of its points.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "semantic_mapper/sources/point_table.h"

namespace tern {

/// The encoding of the points.
enum class PcdData : std::uint8_t { Ascii, Binary, Compressed };

/// The content of a header.
struct PcdHeader {
  PcdData data = PcdData::Ascii;
  std::size_t count = 0;  ///< number of points
  PointColumns columns;   ///< a column per number of a point; a field of COUNT n has n columns of its name
  std::vector<std::size_t> field_ends;  ///< per field, the column after its last one
  std::size_t data_offset = 0;          ///< offset of the first point, bytes
  bool is_moved = false;                ///< VIEWPOINT is not at the origin, or turned
};

/// The name of a field that only fills a record up. Several fields may have it.
inline constexpr const char* kPcdPadding = "_";

/// Reads the header of a PCD file. Errors are those of parse_pcd() (pcd.h).
Result<PcdHeader> parse_pcd_header(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const std::string& label);

}  // namespace tern
