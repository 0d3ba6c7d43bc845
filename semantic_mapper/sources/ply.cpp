#include "semantic_mapper/sources/ply.h"

#include <fmt/format.h>

#include "semantic_mapper/sources/ply_header.h"
#include "semantic_mapper/sources/point_table.h"

namespace tern {
namespace {

Result<CloudFile> read_binary(std::span<const std::uint8_t> bytes, const std::string& file, const PlyHeader& header,
                              const PointFrame& frame) {
  std::vector<ColumnPlace> places;
  std::size_t stride = 0;
  for (const NumberType type : header.columns.types) {
    places.push_back({header.data_offset + stride});
    stride += size_of(type);
  }
  for (ColumnPlace& place : places) place.stride = stride;
  const std::size_t fit = (bytes.size() - header.data_offset) / stride;
  if (header.count > fit) {
    return bad_file(file, header.data_offset,
                    fmt::format("{} vertices, but the file ends after {}", header.count, fit));
  }
  const std::endian order = header.format == PlyFormat::BigEndian ? std::endian::big : std::endian::little;
  return read_records(bytes, header.columns, places, header.count, order, frame);
}

}  // namespace

Result<CloudFile> parse_ply(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame,
                            const std::string& label) {
  const auto header = parse_ply_header(bytes, file, label);
  if (!header) return tl::unexpected(header.error());
  if (header->format != PlyFormat::Ascii) return read_binary(bytes, file, *header, frame);
  return read_text_rows(bytes, header->data_offset, file, header->columns, header->count, frame);
}

}  // namespace tern
