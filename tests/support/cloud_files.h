// Point cloud files made in memory: LAS of every version and format, PLY of every kind.
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
  int extra_bytes = 0;  ///< of every record, behind the standard fields
  Vec3 scale = Vec3(0.01, 0.01, 0.01);
  Vec3 offset = Vec3::Zero();
};

/// The file's coordinates are the points' positions, rounded to the scale.
FileBytes las_file(const PointCloud& points, const LasSpec& spec);

enum class PlyKind { Ascii, Little, Big };
/// x, y as double, z as float, an unused short, and the class as uchar under the name `class_property`.
FileBytes ply_file(const PointCloud& points, PlyKind kind, const std::string& class_property = "label");

/// Overwrites sizeof(value) bytes.
template <class T>
void put(FileBytes& bytes, std::size_t at, T value, std::endian order = std::endian::little) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
  if (bytes.size() < at + sizeof(T)) bytes.resize(at + sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[at + i] = raw[order == std::endian::native ? i : sizeof(T) - 1 - i];
}

}  // namespace tern::support
