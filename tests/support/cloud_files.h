// Files of maps made in memory: LAS of all versions and formats, PLY and PCD of all encodings, text, OctoMap.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/world/voxel_map.h"
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

enum class PcdKind { Ascii, Binary, Compressed };
/// Returns a PCD file with x, y, z as float and the class as uint32 named `class_field`. Between them are a padding of
/// three bytes and a normal of three floats.
FileBytes pcd_file(const PointCloud& points, PcdKind kind, const std::string& class_field = "label");

/// Returns bytes as LZF: repetitions of the byte before, and literals.
FileBytes lzf_compressed(const FileBytes& bytes);

/// Returns a text file with x, y, z and the class in columns, under a first line of names.
FileBytes text_file(const PointCloud& points, char separator = ' ');

/// Returns an OctoMap with voxels of 0.5 m from the origin on. Voxel (x, y, z) is unknown, free or occupied:
/// labels[x + side (y + side z)]. Cubes of one label are one leaf.
/// @param side  voxels per axis, a power of two
FileBytes octomap_file(const std::vector<VoxelLabel>& labels, int side, bool is_binary);

/// Flips, overwrites, removes, repeats or cuts off some bytes, mostly in the header.
FileBytes mutated(FileBytes bytes, Rng& rng);

/// Overwrites the sizeof(value) bytes at `offset`.
template <class T>
void put(FileBytes& bytes, std::size_t at, T value, std::endian order = std::endian::little) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
  if (bytes.size() < at + sizeof(T)) bytes.resize(at + sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[at + i] = raw[order == std::endian::native ? i : sizeof(T) - 1 - i];
}

}  // namespace tern::support
