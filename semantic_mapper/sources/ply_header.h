// The head of a PLY file: what its vertices are made of.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace tern {

enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };
enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Bytes of a binary value.
std::size_t size_of(PlyType type);

struct PlyHeader {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  PlyFormat format = PlyFormat::Ascii;
  std::size_t count = 0;                            ///< vertices
  std::vector<PlyType> properties;                  ///< of a vertex, in file order
  std::size_t position[3] = {kNone, kNone, kNone};  ///< indices of x, y, z; all set
  std::size_t class_number = kNone;                 ///< index of the class, kNone without one
  std::size_t data_offset = 0;                      ///< where the first vertex begins
};

/// Reads the header as parse_ply says.
Result<PlyHeader> parse_ply_header(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace tern
