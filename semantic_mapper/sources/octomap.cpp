#include "semantic_mapper/sources/octomap.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "core/wire/message_limits.h"
#include "semantic_mapper/sources/byte_reader.h"
#include "semantic_mapper/sources/point_table.h"

namespace tern {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// An OctoMap has 16 levels below its root; the root's centre is the origin.
constexpr int kLevels = 16;
constexpr std::int32_t kHalf = 1 << (kLevels - 1);

struct Header {
  bool is_binary = false;  ///< .bt: two bits per child; else .ot: log-odds per node
  bool has_colour = false;
  bool is_empty = false;
  double resolution = 0.0;
  std::size_t data_offset = 0;
};

/// Takes a line of the header; unknown ones mean nothing. @return an error text; "" if the line is accepted
std::string take_line(std::string_view line, Header& header) {
  const auto words = words_of(line);
  if (words.empty() || words[0].starts_with('#')) return "";
  if (words.size() != 2) return "";
  if (words[0] == "id") {
    header.has_colour = words[1] == "ColorOcTree";
    if (header.has_colour || words[1] == "OcTree") return "";
    return fmt::format("a tree of the kind {}: OcTree and ColorOcTree are read", words[1].substr(0, 40));
  }
  if (words[0] == "size") {
    const auto size = whole_number(words[1]);
    header.is_empty = size && *size == 0;
    return size ? "" : fmt::format("size {} is not a number", words[1].substr(0, 40));
  }
  if (words[0] == "res") {
    std::size_t at = 0;
    header.resolution = next_number(words[1], at).value_or(0.0);
    const bool is_legal = std::isfinite(header.resolution) && header.resolution > 0.0;
    return is_legal ? "" : fmt::format("res {} is not a positive number", words[1].substr(0, 40));
  }
  return "";
}

Result<Header> read_header(Bytes bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kMaxOctoMapHeader));
  Header header;
  header.is_binary = text.starts_with("# Octomap OcTree binary file");
  if (!header.is_binary && !text.starts_with("# Octomap OcTree file")) {
    return bad_file(file, 0,
                    "no OctoMap: it does not begin with # Octomap OcTree file, or binary file "
                    "(convert_octree of octomap-tools converts older files)");
  }
  std::size_t at = 0;
  while (true) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos)
      return bad_file(file, at, fmt::format("no line data within {} bytes", text.size()));
    const std::string_view line = text.substr(at, end - at);
    if (line == "data" || line == "data\r") {
      if (header.resolution == 0.0) return bad_file(file, at, "no line res");
      header.data_offset = end + 1;
      return header;
    }
    if (const std::string problem = take_line(line, header); !problem.empty()) return bad_file(file, at, problem);
    at = end + 1;
  }
}

/// A node in the making: the lower corner and the side of its cube, voxels.
struct Node {
  std::array<std::int32_t, 3> low{-kHalf, -kHalf, -kHalf};
  std::int32_t side = 2 * kHalf;

  [[nodiscard]] Node child(unsigned i) const {
    const std::int32_t half = side / 2;
    Node child{low, half};
    for (unsigned axis = 0; axis < 3; ++axis) child.low[axis] += (i >> axis & 1U) != 0 ? half : 0;
    return child;
  }
};

/// Reads the nodes depth first. Each call returns an error text; "" if all is well.
class TreeReader {
 public:
  TreeReader(Bytes bytes, const Header& header, const PointFrame& frame)
      : bytes_(bytes), header_(header), at_(header.data_offset) {
    map.resolution = header.resolution * frame.metres_per_unit;
    map.origin = -frame.origin * frame.metres_per_unit;
  }

  OctoMapFile map;

  std::string read() {
    if (header_.is_empty) return "";
    return header_.is_binary ? read_binary(Node{}) : read_full(Node{});
  }
  [[nodiscard]] std::size_t offset() const { return at_; }

 private:
  /// Two bits per child, child 0 in the low bits of the first byte: 1 free, 2 occupied, 3 an inner node, 0 unknown.
  std::string read_binary(const Node& node) {
    if (node.side == 1) return too_deep();
    if (bytes_.size() - at_ < 2) return "the file ends within the tree";
    const unsigned states = read_number<std::uint16_t>(bytes_, at_);
    at_ += 2;
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned state = states >> (2 * i) & 3U;
      if (state != 1 && state != 2) continue;
      if (std::string problem = add(node.child(i), state == 2); !problem.empty()) return problem;
    }
    for (unsigned i = 0; i < 8; ++i) {
      if ((states >> (2 * i) & 3U) != 3) continue;
      if (std::string problem = read_binary(node.child(i)); !problem.empty()) return problem;
    }
    return "";
  }

  /// Log-odds as float32, a colour of three bytes in a ColorOcTree, and a bit per child.
  std::string read_full(const Node& node) {
    const std::size_t size = sizeof(float) + (header_.has_colour ? 3 : 0) + 1;
    if (bytes_.size() - at_ < size) return "the file ends within the tree";
    const auto log_odds = read_number<float>(bytes_, at_);
    if (!std::isfinite(log_odds)) return fmt::format("log-odds of {}", log_odds);
    const unsigned children = bytes_[at_ + size - 1];
    if (children != 0 && node.side == 1) return too_deep();
    at_ += size;
    if (children == 0) return add(node, log_odds >= 0.0F);
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> i & 1U) == 0) continue;
      if (std::string problem = read_full(node.child(i)); !problem.empty()) return problem;
    }
    return "";
  }

  std::string add(const Node& node, bool is_occupied) {
    if (map.leaves.size() == kMaxOctoLeaves) return fmt::format("more than {} leaves", kMaxOctoLeaves);
    const OctoLeaf leaf{node.low, node.side, is_occupied};
    const Box box = map.box(leaf);
    // NaN fails this comparison.
    const bool is_near = (box.min().array() >= -kMaxCoordinate).all() && (box.max().array() <= kMaxCoordinate).all();
    if (is_near) {
      map.leaves.push_back(leaf);
    } else {
      ++map.too_far;
    }
    return "";
  }
  static std::string too_deep() { return fmt::format("a node below level {}", kLevels); }

  Bytes bytes_;
  const Header& header_;
  std::size_t at_;
};

}  // namespace

Box OctoMapFile::box(const OctoLeaf& leaf) const {
  const Vec3 low(leaf.low[0], leaf.low[1], leaf.low[2]);
  return {origin + low * resolution, origin + (low + Vec3::Constant(leaf.side)) * resolution};
}

Result<OctoMapFile> parse_octomap(Bytes bytes, const std::string& file, const PointFrame& frame) {
  const auto header = read_header(bytes, file);
  if (!header) return tl::unexpected(header.error());
  TreeReader reader(bytes, *header, frame);
  if (const std::string problem = reader.read(); !problem.empty()) return bad_file(file, reader.offset(), problem);
  return std::move(reader.map);
}

}  // namespace tern
