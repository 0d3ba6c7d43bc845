#include "tests/support/cloud_files.h"

#include <cmath>
#include <cstdio>

namespace tern::support {

FileBytes las_file(const PointCloud& points, const LasSpec& spec) {
  constexpr int kLengths[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const std::size_t header = spec.minor == 4 ? 375 : spec.minor == 3 ? 235 : 227;
  const auto length = static_cast<std::size_t>(kLengths[spec.format] + spec.extra_bytes);
  FileBytes bytes(header + length * points.size(), 0);
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>("LASF"[i]);
  bytes[24] = 1;
  bytes[25] = static_cast<std::uint8_t>(spec.minor);
  put(bytes, 94, static_cast<std::uint16_t>(header));
  put(bytes, 96, static_cast<std::uint32_t>(header));
  bytes[104] = static_cast<std::uint8_t>(spec.format);
  put(bytes, 105, static_cast<std::uint16_t>(length));
  if (spec.minor == 4) put(bytes, 247, static_cast<std::uint64_t>(points.size()));
  if (spec.format < 6) put(bytes, 107, static_cast<std::uint32_t>(points.size()));
  for (std::size_t i = 0; i < 3; ++i) {
    put(bytes, 131 + 8 * i, spec.scale[static_cast<int>(i)]);
    put(bytes, 155 + 8 * i, spec.offset[static_cast<int>(i)]);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t at = header + k * length;
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = static_cast<int>(i);
      const double raw = std::round((points[k].position[axis] - spec.offset[axis]) / spec.scale[axis]);
      put(bytes, at + 4 * i, static_cast<std::int32_t>(raw));
    }
    bytes[at + (spec.format < 6 ? 15u : 16u)] = points[k].class_number;
  }
  return bytes;
}

FileBytes ply_file(const PointCloud& points, PlyKind kind, const std::string& class_property) {
  constexpr const char* kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string text = "ply\nformat " + std::string(kFormats[static_cast<int>(kind)]) +
                     " 1.0\ncomment made by a test\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty double x\nproperty double y\nproperty float z\nproperty short other\n" +
                     "property uchar " + class_property +
                     "\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  FileBytes bytes(text.begin(), text.end());
  const std::endian order = kind == PlyKind::Big ? std::endian::big : std::endian::little;
  for (const LabelledPoint& point : points) {
    const Vec3& p = point.position;
    if (kind == PlyKind::Ascii) {
      char line[200];
      const int n =
          std::snprintf(line, sizeof line, "%.17g %.17g %.9g -7 %d\n", p.x(), p.y(), p.z(), point.class_number);
      bytes.insert(bytes.end(), line, line + n);
      continue;
    }
    put(bytes, bytes.size(), p.x(), order);
    put(bytes, bytes.size(), p.y(), order);
    put(bytes, bytes.size(), static_cast<float>(p.z()), order);
    put(bytes, bytes.size(), static_cast<std::int16_t>(-7), order);
    bytes.push_back(point.class_number);
  }
  return bytes;
}

}  // namespace tern::support
