#include "semantic_mapper/sources/las.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "semantic_mapper/sources/byte_reader.h"

namespace tern {
namespace {

// Offsets in the public header block; they are the same in all versions.
constexpr std::size_t kMajorAt = 24;
constexpr std::size_t kMinorAt = 25;
constexpr std::size_t kDataOffsetAt = 96;
constexpr std::size_t kFormatAt = 104;
constexpr std::size_t kRecordLengthAt = 105;
constexpr std::size_t kLegacyCountAt = 107;
constexpr std::size_t kScaleAt = 131;
constexpr std::size_t kOffsetAt = 155;
constexpr std::size_t kCount14At = 247;
constexpr std::size_t kHeaderSize = 227;
constexpr std::size_t kHeaderSize14 = 375;

/// The size of a record's standard fields by format, bytes. Files may append fields of their own.
constexpr std::array<std::size_t, 11> kRecordLength{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
/// LASzip adds this to the format of compressed records.
constexpr std::uint8_t kCompressedFrom = 128;

bool is_las(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && std::string_view(reinterpret_cast<const char*>(bytes.data()), 4) == "LASF";
}

struct LasHeader {
  std::size_t data_offset = 0;
  std::size_t record_length = 0;
  std::size_t count = 0;
  bool wide_class = false;  ///< formats 6–10
  Vec3 scale, offset;
};

Vec3 read_vec3(std::span<const std::uint8_t> bytes, std::size_t at) {
  return {read_number<double>(bytes, at), read_number<double>(bytes, at + 8), read_number<double>(bytes, at + 16)};
}

Result<std::uint64_t> read_count(std::span<const std::uint8_t> bytes, const std::string& file) {
  const auto legacy = read_number<std::uint32_t>(bytes, kLegacyCountAt);
  if (bytes[kMinorAt] < 4) return legacy;
  if (bytes.size() < kHeaderSize14) {
    return bad_file(file, bytes.size(), fmt::format("the file ends within the header of {} bytes", kHeaderSize14));
  }
  const auto count = read_number<std::uint64_t>(bytes, kCount14At);
  return count == 0 ? legacy : count;  // some writers of 1.4 fill in the legacy count alone
}

Result<LasHeader> read_header(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.size() < kHeaderSize) {
    return bad_file(file, bytes.size(), fmt::format("the file ends within the header of {} bytes", kHeaderSize));
  }
  if (!is_las(bytes)) return bad_file(file, 0, "no LAS file: it does not begin with LASF");
  if (bytes[kMajorAt] != 1 || bytes[kMinorAt] > 4) {
    return bad_file(file, kMajorAt,
                    fmt::format("LAS version {}.{} (limit 1.0 to 1.4)", bytes[kMajorAt], bytes[kMinorAt]));
  }
  const std::uint8_t format = bytes[kFormatAt];
  if (format >= kCompressedFrom) {
    return bad_file(file, kFormatAt,
                    "compressed (LAZ) points: decompress the file first, as by `pdal translate FILE.laz FILE.las`");
  }
  if (format >= kRecordLength.size())
    return bad_file(file, kFormatAt, fmt::format("point format {} (limit 0 to 10)", format));
  LasHeader header;
  header.wide_class = format >= 6;
  header.data_offset = read_number<std::uint32_t>(bytes, kDataOffsetAt);
  header.record_length = read_number<std::uint16_t>(bytes, kRecordLengthAt);
  header.scale = read_vec3(bytes, kScaleAt);
  header.offset = read_vec3(bytes, kOffsetAt);
  if (header.record_length < kRecordLength[format]) {
    return bad_file(file, kRecordLengthAt,
                    fmt::format("records of {} bytes (format {} has at least {})", header.record_length, format,
                                kRecordLength[format]));
  }
  const auto count = read_count(bytes, file);
  if (!count) return tl::unexpected(count.error());
  const std::size_t at = bytes[kMinorAt] < 4 ? kLegacyCountAt : kCount14At;
  if (*count > static_cast<std::uint64_t>(kMaxCloudPoints)) {
    return bad_file(file, at, fmt::format("{} points (limit {})", *count, kMaxCloudPoints));
  }
  header.count = static_cast<std::size_t>(*count);
  if (header.data_offset < kHeaderSize || header.data_offset > bytes.size()) {
    return bad_file(file, kDataOffsetAt,
                    fmt::format("points begin at {} (limit {} to {})", header.data_offset, kHeaderSize, bytes.size()));
  }
  const std::size_t fit = (bytes.size() - header.data_offset) / header.record_length;
  if (header.count > fit)
    return bad_file(file, at, fmt::format("{} points, but the file ends after {}", header.count, fit));
  return header;
}

}  // namespace

bool is_compressed_las(std::span<const std::uint8_t> bytes) {
  return is_las(bytes) && bytes.size() > kFormatAt && bytes[kFormatAt] >= kCompressedFrom;
}

Result<CloudFile> parse_las(std::span<const std::uint8_t> bytes, const std::string& file, const PointFrame& frame) {
  const auto header = read_header(bytes, file);
  if (!header) return tl::unexpected(header.error());
  CloudFile cloud;
  cloud.points.reserve(header->count);
  for (std::size_t i = 0; i < header->count; ++i) {
    const std::size_t at = header->data_offset + i * header->record_length;
    const bool withheld = header->wide_class ? (bytes[at + 15] & 0x04) != 0 : (bytes[at + 15] & 0x80) != 0;
    if (withheld) continue;
    const Vec3 raw(read_number<std::int32_t>(bytes, at), read_number<std::int32_t>(bytes, at + 4),
                   read_number<std::int32_t>(bytes, at + 8));
    const Vec3 p_file = raw.cwiseProduct(header->scale) + header->offset;
    cloud.add(p_file, frame, static_cast<double>(header->wide_class ? bytes[at + 16] : bytes[at + 15] & 0x1f));
  }
  return cloud;
}

}  // namespace tern
