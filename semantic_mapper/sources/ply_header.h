// The header of a PLY file: the properties of its vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/base/result.h"
#include "semantic_mapper/sources/point_table.h"

namespace tern {

/// The encoding of the values.
enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };

/// The content of a header.
struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::size_t count = 0;        ///< number of vertices
  PointColumns columns;         ///< the properties of a vertex
  std::size_t data_offset = 0;  ///< offset of the first vertex, bytes
};

/// Reads the header of a PLY file. Errors are those of parse_ply() (ply.h).
Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const std::string& label);

}  // namespace tern
