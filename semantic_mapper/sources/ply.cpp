#include "semantic_mapper/sources/ply.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "semantic_mapper/sources/byte_reader.h"
#include "semantic_mapper/sources/ply_header.h"

namespace tern {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// Distance of a float32 to the next larger one.
double spacing_of(double value) {
  const auto number = static_cast<float>(value);
  return static_cast<double>(std::nextafter(number, std::numeric_limits<float>::infinity())) - value;
}

/// Puts vertices together from their properties' values.
class Vertices {
 public:
  Vertices(const PlyHeader& header, const PointFrame& frame) : header_(header), frame_(frame) {
    cloud_.has_labels = header.class_number != PlyHeader::kNone;
    cloud_.properties = header.names;
    cloud_.points.reserve(header.count);
  }

  void add(const std::vector<double>& values) {
    const Vec3 p_file(values[header_.position[0]], values[header_.position[1]], values[header_.position[2]]);
    const std::size_t before = cloud_.points.size();
    cloud_.add(p_file, frame_, cloud_.has_labels ? values[header_.class_number] : 0.0);
    if (cloud_.points.size() == before) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool is_float = header_.properties[header_.position[axis]] == PlyType::Float32;
      if (is_float) largest_float_ = std::max(largest_float_, std::abs(p_file[static_cast<int>(axis)]));
    }
  }
  CloudFile finish() {
    if (largest_float_ > 0.0) cloud_.spacing = spacing_of(largest_float_) * frame_.metres_per_unit;
    return std::move(cloud_);
  }

 private:
  const PlyHeader& header_;
  const PointFrame& frame_;
  CloudFile cloud_;
  double largest_float_ = 0.0;  // file's units
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
Result<CloudFile> read_points(const std::string& file, const PlyHeader& header, const PointFrame& frame,
                              const Next& next) {
  Vertices vertices(header, frame);
  std::vector<double> values;
  std::size_t at = header.data_offset;
  for (std::size_t i = 0; i < header.count; ++i) {
    values.clear();
    for (const PlyType type : header.properties) {
      const std::optional<double> value = next(at, type);
      if (!value) return bad_file(file, at, fmt::format("no number where vertex {} needs one", i));
      values.push_back(*value);
    }
    vertices.add(values);
  }
  return vertices.finish();
}

Result<CloudFile> read_binary(Bytes bytes, const std::string& file, const PlyHeader& header, const PointFrame& frame) {
  std::size_t stride = 0;
  for (const PlyType type : header.properties) stride += size_of(type);
  const std::size_t fit = stride == 0 ? 0 : (bytes.size() - header.data_offset) / stride;
  if (header.count > fit) {
    return bad_file(file, header.data_offset,
                    fmt::format("{} vertices, but the file ends after {}", header.count, fit));
  }
  const std::endian order = header.format == PlyFormat::BigEndian ? std::endian::big : std::endian::little;
  return read_points(file, header, frame, [&](std::size_t& at, PlyType type) -> std::optional<double> {
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

Result<CloudFile> read_ascii(Bytes bytes, const std::string& file, const PlyHeader& header, const PointFrame& frame) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // A value takes at least two characters, so the reserved memory is bounded by the file's size.
  const std::size_t most = (bytes.size() - header.data_offset + 1) / (2 * header.properties.size());
  if (header.count > most) {
    return bad_file(file, header.data_offset,
                    fmt::format("{} vertices, but the file has room for {}", header.count, most));
  }
  return read_points(file, header, frame, [&](std::size_t& at, PlyType) { return next_number(text, at); });
}

}  // namespace

Result<CloudFile> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame,
                            const std::string& label) {
  const auto header = parse_ply_header(bytes, file, label);
  if (!header) return tl::unexpected(header.error());
  if (header->format == PlyFormat::Ascii) return read_ascii(bytes, file, *header, frame);
  return read_binary(bytes, file, *header, frame);
}

}  // namespace tern
