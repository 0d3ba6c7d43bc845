// The header of a PLY file: the properties of its vertices.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tern {

/// The encoding of the values.
enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };
/// The type of a value.
enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Returns the size of a binary value, bytes.
std::size_t size_of(PlyType type);

/// The content of a header.
struct PlyHeader {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  PlyFormat format = PlyFormat::Ascii;
  std::size_t count = 0;                            ///< number of vertices
  std::vector<PlyType> properties;                  ///< properties of a vertex, in the file's order
  std::size_t position[3] = {kNone, kNone, kNone};  ///< indices of x, y, z; all are set
  std::size_t class_number = kNone;                 ///< index of the class; kNone: there is none
  std::vector<std::string> names;                   ///< names of the properties, in the file's order
  std::size_t data_offset = 0;                      ///< offset of the first vertex, bytes
};

/// Reads the header of a PLY file. Errors are those of parse_ply() (ply.h).
Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const std::string& label);

}  // namespace tern
