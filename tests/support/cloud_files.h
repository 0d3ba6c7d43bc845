// Point cloud files made in memory: LAS files of all versions and formats, PLY files of all encodings.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern::support {

using FileBytes = std::vector<std::uint8_t>;

struct LasSpec {
  int minor = 2;        ///< version 1.minor
  int format = 3;       ///< point data record format
  int extra_bytes = 0;  ///< after the standard fields of each record
  Vec3 scale = Vec3(0.01, 0.01, 0.01);
  Vec3 offset = Vec3::Zero();
};

/// Returns a LAS file whose coordinates are the positions, rounded to the scale.
FileBytes las_file(const PointCloud& points, const LasSpec& spec);

enum class PlyKind { Ascii, Little, Big };
/// Returns a PLY file with x, y as double, z as float, an unused short, and the class as uchar named `class_property`.
FileBytes ply_file(const PointCloud& points, PlyKind kind, const std::string& class_property = "label");

/// Overwrites the sizeof(value) bytes at `offset`.
template <class T>
void put(FileBytes& bytes, std::size_t at, T value, std::endian order = std::endian::little) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
  if (bytes.size() < at + sizeof(T)) bytes.resize(at + sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[at + i] = raw[order == std::endian::native ? i : sizeof(T) - 1 - i];
}

}  // namespace tern::support
