#include "semantic_mapper/sources/ply.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "semantic_mapper/sources/byte_reader.h"
#include "semantic_mapper/sources/ply_header.h"

namespace tern {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// Assembles vertices from the values of their properties.
class Vertices {
 public:
  Vertices(const PlyHeader& header, const std::string& file, const PointFrame& frame)
      : header_(header), file_(file), frame_(frame) {}

  /// @param at  the vertex's offset, for the error
  Result<LabelledPoint> point(const std::vector<double>& values, std::size_t at) const {
    const Vec3 p_file(values[header_.position[0]], values[header_.position[1]], values[header_.position[2]]);
    const auto p = frame_.to_world(p_file);
    if (!p) {
      return bad_file(file_, at,
                      fmt::format("a vertex at ({:g}, {:g}, {:g}) is too far from the origin that was given",
                                  p_file.x(), p_file.y(), p_file.z()));
    }
    if (header_.class_number == PlyHeader::kNone) return LabelledPoint{*p, 0};
    const double number = values[header_.class_number];
    if (!(number >= 0.0 && number <= 255.0) || number != std::floor(number)) {
      return bad_file(file_, at, fmt::format("class {:g} is not an integer in [0, 255]", number));
    }
    return LabelledPoint{*p, static_cast<std::uint8_t>(number)};
  }

 private:
  const PlyHeader& header_;
  const std::string& file_;
  const PointFrame& frame_;
};

double read_value(Bytes bytes, std::size_t at, PlyType type, std::endian order) {
  switch (type) {
    case PlyType::Int8: return read_number<std::int8_t>(bytes, at, order);
    case PlyType::Uint8: return read_number<std::uint8_t>(bytes, at, order);
    case PlyType::Int16: return read_number<std::int16_t>(bytes, at, order);
    case PlyType::Uint16: return read_number<std::uint16_t>(bytes, at, order);
    case PlyType::Int32: return read_number<std::int32_t>(bytes, at, order);
    case PlyType::Uint32: return read_number<std::uint32_t>(bytes, at, order);
    case PlyType::Float32: return static_cast<double>(read_number<float>(bytes, at, order));
    case PlyType::Float64: return read_number<double>(bytes, at, order);
  }
  return 0.0;
}

/// Returns the points of the vertices. `next` reads the value at an offset and advances the offset; nullopt at the
/// end.
template <class Next>
Result<PointCloud> read_points(const std::string& file, const PlyHeader& header, const Vertices& vertices,
                               const Next& next) {
  PointCloud cloud;
  cloud.reserve(header.count);
  std::vector<double> values;
  std::size_t at = header.data_offset;
  for (std::size_t i = 0; i < header.count; ++i) {
    const std::size_t begin = at;
    values.clear();
    for (const PlyType type : header.properties) {
      const std::optional<double> value = next(at, type);
      if (!value) return bad_file(file, at, fmt::format("no number where vertex {} needs one", i));
      values.push_back(*value);
    }
    const auto point = vertices.point(values, begin);
    if (!point) return tl::unexpected(point.error());
    cloud.push_back(*point);
  }
  return cloud;
}

Result<PointCloud> read_binary(Bytes bytes, const std::string& file, const PlyHeader& header,
                               const Vertices& vertices) {
  std::size_t stride = 0;
  for (const PlyType type : header.properties) stride += size_of(type);
  const std::size_t fit = stride == 0 ? 0 : (bytes.size() - header.data_offset) / stride;
  if (header.count > fit) {
    return bad_file(file, header.data_offset,
                    fmt::format("{} vertices, but the file ends after {}", header.count, fit));
  }
  const std::endian order = header.format == PlyFormat::BigEndian ? std::endian::big : std::endian::little;
  return read_points(file, header, vertices, [&](std::size_t& at, PlyType type) -> std::optional<double> {
    return read_value(bytes, std::exchange(at, at + size_of(type)), type, order);
  });
}

/// Reads one number of text separated by white space, and advances `at` behind it.
std::optional<double> next_number(std::string_view text, std::size_t& at) {
  at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
  if (at < text.size() && text[at] == '+') ++at;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  const auto stop = static_cast<std::size_t>(end - text.data());
  const bool ends_well = stop == text.size() || std::string_view(" \t\r\n").find(text[stop]) != std::string_view::npos;
  if (error != std::errc() || !ends_well) return std::nullopt;
  at = stop;
  return value;
}

Result<PointCloud> read_ascii(Bytes bytes, const std::string& file, const PlyHeader& header, const Vertices& vertices) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // A value takes at least two characters, so the reserved memory is bounded by the file's size.
  const std::size_t most = (bytes.size() - header.data_offset + 1) / (2 * header.properties.size());
  if (header.count > most) {
    return bad_file(file, header.data_offset,
                    fmt::format("{} vertices, but the file has room for {}", header.count, most));
  }
  return read_points(file, header, vertices, [&](std::size_t& at, PlyType) { return next_number(text, at); });
}

}  // namespace

Result<PointCloud> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame) {
  const auto header = parse_ply_header(bytes, file);
  if (!header) return tl::unexpected(header.error());
  const Vertices vertices(*header, file, frame);
  if (header->format == PlyFormat::Ascii) return read_ascii(bytes, file, *header, vertices);
  return read_binary(bytes, file, *header, vertices);
}

}  // namespace tern
