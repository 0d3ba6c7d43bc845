#include "tests/support/cloud_files.h"

#include <algorithm>
#include <array>
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

FileBytes mutated(FileBytes bytes, Rng& rng) {
  for (int n = 1 + static_cast<int>(rng.uniform(0, 4)); n > 0 && !bytes.empty(); --n) {
    const double reach =
        rng.uniform() < 0.7 ? std::min(400.0, static_cast<double>(bytes.size())) : static_cast<double>(bytes.size());
    const auto at = static_cast<std::ptrdiff_t>(rng.uniform(0, reach));
    const auto length =
        std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(rng.uniform(0, 9)), std::ssize(bytes) - at);
    switch (static_cast<int>(rng.uniform(0, 6))) {
      case 0:
        bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1 << static_cast<int>(rng.uniform(0, 8)));
        break;
      case 1: bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(rng.uniform(0, 256)); break;
      case 2: std::fill_n(bytes.begin() + at, length, rng.uniform() < 0.5 ? 0xff : 0x00); break;
      case 3: bytes.erase(bytes.begin() + at, bytes.begin() + at + length); break;
      case 4:
        bytes.insert(bytes.begin() + at, static_cast<std::size_t>(length), bytes[static_cast<std::size_t>(at)]);
        break;
      default: bytes.resize(static_cast<std::size_t>(at)); break;
    }
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

FileBytes lzf_compressed(const FileBytes& bytes) {
  constexpr std::size_t kMaxRun = 264;
  constexpr std::size_t kMaxLiteral = 32;
  FileBytes out;
  std::size_t literal = 0;  // where the control byte of the present literals is; 0: there are none
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t run = 0;
    while (i > 0 && i + run < bytes.size() && run < kMaxRun && bytes[i + run] == bytes[i - 1]) ++run;
    if (run >= 3) {
      const std::size_t more = run - 2;
      out.push_back(static_cast<std::uint8_t>(more < 7 ? more << 5 : 7 << 5));
      if (more >= 7) out.push_back(static_cast<std::uint8_t>(more - 7));
      out.push_back(0);  // distance 1
      literal = 0;
      i += run;
      continue;
    }
    if (literal == 0 || out[literal - 1] == kMaxLiteral - 1) {
      out.push_back(0);
      literal = out.size();
    } else {
      ++out[literal - 1];
    }
    out.push_back(bytes[i++]);
  }
  return out;
}

namespace {

struct PcdPoint {
  std::array<float, 3> position;
  std::array<float, 3> normal{0.0F, 0.0F, 1.0F};
  std::uint32_t class_number;
};

PcdPoint pcd_point(const LabelledPoint& point) {
  const Eigen::Vector3f p = point.position.cast<float>();
  return {{p.x(), p.y(), p.z()}, {0.0F, 0.0F, 1.0F}, point.class_number};
}

/// Field after field, without the padding, as PCL's writer does.
FileBytes pcd_fields(const PointCloud& points) {
  FileBytes bytes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const LabelledPoint& point : points) put(bytes, bytes.size(), pcd_point(point).position[axis]);
  }
  for (const LabelledPoint& point : points) {
    for (const float n : pcd_point(point).normal) put(bytes, bytes.size(), n);
  }
  for (const LabelledPoint& point : points) put(bytes, bytes.size(), pcd_point(point).class_number);
  return bytes;
}

FileBytes pcd_records(const PointCloud& points) {
  FileBytes bytes;
  for (const LabelledPoint& labelled : points) {
    const PcdPoint point = pcd_point(labelled);
    for (const float p : point.position) put(bytes, bytes.size(), p);
    bytes.insert(bytes.end(), 3, 0xab);
    for (const float n : point.normal) put(bytes, bytes.size(), n);
    put(bytes, bytes.size(), point.class_number);
  }
  return bytes;
}

FileBytes pcd_text(const PointCloud& points) {
  FileBytes bytes;
  for (const LabelledPoint& point : points) {
    const Eigen::Vector3f p = point.position.cast<float>();
    char line[200];
    const int n = std::snprintf(line, sizeof line, "%.9g %.9g %.9g 0 0 0 0 0 1 %d\n", static_cast<double>(p.x()),
                                static_cast<double>(p.y()), static_cast<double>(p.z()), point.class_number);
    bytes.insert(bytes.end(), line, line + n);
  }
  return bytes;
}

/// Writes the nodes of an OctoMap depth first.
class OctoWriter {
 public:
  OctoWriter(const std::vector<VoxelLabel>& labels, int side, FileBytes& bytes)
      : labels_(labels), side_(side), bytes_(bytes) {}

  void write_binary(const Eigen::Vector3i& low, int side) {
    unsigned states = 0;
    for (int i = 0; i < 8; ++i) {
      const VoxelLabel* label = uniform(child(low, side, i), side / 2);
      const unsigned state = label == nullptr                 ? 3
                             : *label == VoxelLabel::Occupied ? 2
                             : *label == VoxelLabel::Free     ? 1
                                                              : 0;
      states |= state << (2 * i);
    }
    put(bytes_, bytes_.size(), static_cast<std::uint16_t>(states));
    for (int i = 0; i < 8; ++i) {
      if ((states >> (2 * i) & 3U) == 3) write_binary(child(low, side, i), side / 2);
    }
  }

  void write_full(const Eigen::Vector3i& low, int side) {
    const VoxelLabel* label = uniform(low, side);
    const bool is_leaf = label != nullptr;
    put(bytes_, bytes_.size(), is_leaf && *label == VoxelLabel::Free ? -0.4F : 0.85F);
    const std::size_t at = bytes_.size();
    bytes_.push_back(0);
    for (int i = 0; i < 8 && !is_leaf; ++i) {
      const VoxelLabel* inner = uniform(child(low, side, i), side / 2);
      if (inner != nullptr && *inner == VoxelLabel::Unknown) continue;
      bytes_[at] = static_cast<std::uint8_t>(bytes_[at] | 1U << i);
      write_full(child(low, side, i), side / 2);
    }
  }

 private:
  static Eigen::Vector3i child(const Eigen::Vector3i& low, int side, int i) {
    return low + side / 2 * Eigen::Vector3i(i & 1, i >> 1 & 1, i >> 2 & 1);
  }
  /// The label of a cube; null if it has several.
  [[nodiscard]] const VoxelLabel* uniform(const Eigen::Vector3i& low, int side) const {
    static constexpr VoxelLabel kOutside = VoxelLabel::Unknown;
    if ((low.array() + side <= 0).any() || (low.array() >= side_).any()) return &kOutside;
    if ((low.array() < 0).any() || (low.array() + side > side_).any()) return nullptr;
    const auto at = [&](int x, int y, int z) { return &labels_[idx(x + side_ * (y + side_ * z))]; };
    const VoxelLabel* first = at(low.x(), low.y(), low.z());
    for (int i = 0; i < side * side * side; ++i) {
      if (*at(low.x() + i % side, low.y() + i / side % side, low.z() + i / side / side) != *first) return nullptr;
    }
    return first;
  }

  const std::vector<VoxelLabel>& labels_;
  int side_;
  FileBytes& bytes_;
};

}  // namespace

FileBytes pcd_file(const PointCloud& points, PcdKind kind, const std::string& class_field) {
  constexpr const char* kNames[] = {"ascii", "binary", "binary_compressed"};
  const std::string count = std::to_string(points.size());
  const std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z _ normal " +
                           class_field + "\nSIZE 4 4 4 1 4 4\nTYPE F F F U F U\nCOUNT 1 1 1 3 3 1\nWIDTH " + count +
                           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " +
                           kNames[static_cast<int>(kind)] + "\n";
  FileBytes bytes(text.begin(), text.end());
  if (kind == PcdKind::Ascii || kind == PcdKind::Binary) {
    const FileBytes data = kind == PcdKind::Ascii ? pcd_text(points) : pcd_records(points);
    bytes.insert(bytes.end(), data.begin(), data.end());
    return bytes;
  }
  const FileBytes fields = pcd_fields(points);
  const FileBytes packed = lzf_compressed(fields);
  put(bytes, bytes.size(), static_cast<std::uint32_t>(packed.size()));
  put(bytes, bytes.size(), static_cast<std::uint32_t>(fields.size()));
  bytes.insert(bytes.end(), packed.begin(), packed.end());
  return bytes;
}

FileBytes text_file(const PointCloud& points, char separator) {
  std::string text = "//X Y Z Classification\n";
  std::replace(text.begin(), text.end(), ' ', separator);
  for (const LabelledPoint& point : points) {
    char line[200];
    const Vec3& p = point.position;
    std::snprintf(line, sizeof line, "%.17g%c%.17g%c%.17g%c%d\n", p.x(), separator, p.y(), separator, p.z(), separator,
                  point.class_number);
    text += line;
  }
  return {text.begin(), text.end()};
}

FileBytes octomap_file(const std::vector<VoxelLabel>& labels, int side, bool is_binary) {
  constexpr int kHalf = 1 << 15;
  const std::string text = std::string(is_binary ? "# Octomap OcTree binary file\n" : "# Octomap OcTree file\n") +
                           "# made by a test\nid OcTree\nsize 1\nres 0.5\ndata\n";
  FileBytes bytes(text.begin(), text.end());
  OctoWriter writer(labels, side, bytes);
  const Eigen::Vector3i root = Eigen::Vector3i::Constant(-kHalf);
  if (is_binary) {
    writer.write_binary(root, 2 * kHalf);
  } else {
    writer.write_full(root, 2 * kHalf);
  }
  return bytes;
}

}  // namespace tern::support
