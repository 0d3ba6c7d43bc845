#include "semantic_mapper/sources/pcd.h"

#include <fmt/format.h>

#include "semantic_mapper/sources/byte_reader.h"
#include "semantic_mapper/sources/lzf.h"
#include "semantic_mapper/sources/pcd_header.h"
#include "semantic_mapper/sources/point_table.h"

namespace tern {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::size_t point_size(const PointColumns& columns, bool with_padding) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < columns.names.size(); ++i) {
    if (with_padding || columns.names[i] != kPcdPadding) size += size_of(columns.types[i]);
  }
  return size;
}

Result<CloudFile> read_binary(Bytes bytes, const std::string& file, const PcdHeader& header, const PointFrame& frame) {
  const std::size_t stride = point_size(header.columns, true);
  const std::size_t fit = (bytes.size() - header.data_offset) / stride;
  if (header.count > fit) {
    return bad_file(file, header.data_offset, fmt::format("{} points, but the file ends after {}", header.count, fit));
  }
  std::vector<ColumnPlace> places;
  std::size_t at = header.data_offset;
  for (const NumberType type : header.columns.types) {
    places.push_back({at, stride});
    at += size_of(type);
  }
  return read_records(bytes, header.columns, places, header.count, std::endian::little, frame);
}

/// Compressed data has all numbers of the first field, then all of the next; PCL leaves out the padding. A point's
/// numbers of one field lie together.
std::vector<ColumnPlace> places_by_field(const PcdHeader& header, bool with_padding) {
  const PointColumns& columns = header.columns;
  std::vector<ColumnPlace> places;
  std::size_t begin = 0;
  std::size_t first = 0;  // column
  for (const std::size_t end : header.field_ends) {
    if (first == end) continue;
    const std::size_t size = size_of(columns.types[first]);
    for (std::size_t k = first; k < end; ++k) places.push_back({begin + (k - first) * size, (end - first) * size});
    if (with_padding || columns.names[first] != kPcdPadding) begin += header.count * (end - first) * size;
    first = end;
  }
  return places;
}

Result<CloudFile> read_compressed(Bytes bytes, const std::string& file, const PcdHeader& header,
                                  const PointFrame& frame) {
  const std::size_t at = header.data_offset;
  constexpr std::size_t kSizes = 8;
  if (bytes.size() - at < kSizes) return bad_file(file, bytes.size(), "the file ends before the compressed data");
  const std::size_t packed = read_number<std::uint32_t>(bytes, at);
  const std::size_t size = read_number<std::uint32_t>(bytes, at + 4);
  if (packed > bytes.size() - at - kSizes) {
    return bad_file(file, at,
                    fmt::format("{} compressed bytes, but the file ends after {}", packed, bytes.size() - at - kSizes));
  }
  const bool with_padding = size == header.count * point_size(header.columns, true);
  if (!with_padding && size != header.count * point_size(header.columns, false)) {
    return bad_file(
        file, at + 4,
        fmt::format("{} bytes for {} points of {} bytes", size, header.count, point_size(header.columns, true)));
  }
  const auto data = lzf_decompress(bytes.subspan(at + kSizes, packed), size);
  if (!data) return bad_file(file, at + kSizes, fmt::format("the data do not decompress to {} bytes", size));
  return read_records(*data, header.columns, places_by_field(header, with_padding), header.count, std::endian::little,
                      frame);
}

Result<CloudFile> read_points(Bytes bytes, const std::string& file, const PcdHeader& header, const PointFrame& frame) {
  switch (header.data) {
    case PcdData::Ascii: return read_text_rows(bytes, header.data_offset, file, header.columns, header.count, frame);
    case PcdData::Binary: return read_binary(bytes, file, header, frame);
    case PcdData::Compressed: break;
  }
  return read_compressed(bytes, file, header, frame);
}

}  // namespace

Result<CloudFile> parse_pcd(Bytes bytes, const std::string& file, const PointFrame& frame, const std::string& label) {
  const auto header = parse_pcd_header(bytes, file, label);
  if (!header) return tl::unexpected(header.error());
  auto cloud = read_points(bytes, file, *header, frame);
  if (cloud && header->is_moved) {
    cloud->warning =
        "its VIEWPOINT is not the origin, and is not applied: if the points are in the sensor's frame, "
        "transform the file first";
  }
  return cloud;
}

}  // namespace tern
