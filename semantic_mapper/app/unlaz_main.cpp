// tern-unlaz: writes the points of a LAZ file (compressed LAS) as LAS, for tern-mapper (laz.h).
#include <fmt/format.h>
#include <laszip/laszip_api.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "runtime/command_line.h"
#include "runtime/process.h"
#include "runtime/tool.h"
#include "runtime/version.h"
#include "semantic_mapper/sources/point_cloud.h"

namespace tern {
namespace {

constexpr std::uint16_t kHeaderSize = 375;
/// The formats that are written, and their sizes: 0 for formats 0–5, 6 for 6–10, whose class is a byte.
constexpr std::uint8_t kNarrow = 0, kWide = 6;
constexpr std::uint16_t kNarrowSize = 20, kWideSize = 30;

template <class T>
void put(std::span<std::uint8_t> bytes, std::size_t at, T value) {
  static_assert(std::endian::native == std::endian::little, "LAS is little-endian");
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

void write(std::span<const std::uint8_t> bytes) { std::fwrite(bytes.data(), 1, bytes.size(), stdout); }

/// Throws LASzip's error of the last call. LASzip is not closed: the program ends.
void check(laszip_POINTER laszip, laszip_I32 has_failed) {
  if (has_failed == 0) return;
  laszip_CHAR* reason = nullptr;
  laszip_get_error(laszip, &reason);
  throw std::runtime_error(fmt::format("LASzip: {}", reason == nullptr ? "out of memory" : reason));
}

/// The number of points, as parse_las() takes it of an uncompressed file.
std::uint64_t count_of(const laszip_header_struct& header) {
  const bool has_wide_count = header.version_minor >= 4 && header.extended_number_of_point_records > 0;
  return has_wide_count ? header.extended_number_of_point_records : header.number_of_point_records;
}

/// Writes a header of LAS 1.4.
void write_header(const laszip_header_struct& from, bool is_wide) {
  std::array<std::uint8_t, kHeaderSize> header{'L', 'A', 'S', 'F'};
  put<std::uint8_t>(header, 24, 1);
  put<std::uint8_t>(header, 25, 4);
  put(header, 94, kHeaderSize);
  put<std::uint32_t>(header, 96, kHeaderSize);
  put(header, 104, is_wide ? kWide : kNarrow);
  put(header, 105, is_wide ? kWideSize : kNarrowSize);
  if (!is_wide) put(header, 107, static_cast<std::uint32_t>(count_of(from)));
  const double numbers[] = {from.x_scale_factor, from.y_scale_factor, from.z_scale_factor, from.x_offset,
                            from.y_offset,       from.z_offset,       from.max_x,          from.min_x,
                            from.max_y,          from.min_y,          from.max_z,          from.min_z};
  for (std::size_t i = 0; i < std::size(numbers); ++i) put(header, 131 + 8 * i, numbers[i]);
  put(header, 247, count_of(from));
  write(header);
}

/// Writes position, class and flags.
void write_point(const laszip_point_struct& point, bool is_wide) {
  std::array<std::uint8_t, kWideSize> record{};
  put(record, 0, point.X);
  put(record, 4, point.Y);
  put(record, 8, point.Z);
  const unsigned flags = point.synthetic_flag | point.keypoint_flag << 1U | point.withheld_flag << 2U;
  record[15] =
      static_cast<std::uint8_t>(is_wide ? point.extended_classification_flags : point.classification | flags << 5U);
  if (is_wide) record[16] = point.extended_classification;
  write(std::span(record).first(is_wide ? kWideSize : kNarrowSize));
}

int unlaz(const std::string& file) {
  laszip_POINTER laszip = nullptr;
  if (laszip_create(&laszip) != 0) throw std::runtime_error("LASzip cannot be started");
  laszip_BOOL is_compressed = 0;
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  check(laszip, laszip_request_compatibility_mode(laszip, 1));  // formats 6–10 that older LASzip packed as 1–5
  check(laszip, laszip_open_reader(laszip, file.c_str(), &is_compressed));
  check(laszip, laszip_get_header_pointer(laszip, &header));
  check(laszip, laszip_get_point_pointer(laszip, &point));
  const std::uint64_t count = count_of(*header);
  if (count > static_cast<std::uint64_t>(kMaxCloudPoints)) {
    throw std::runtime_error(fmt::format("{} points (limit {})", count, kMaxCloudPoints));
  }
  const bool is_wide = header->point_data_format >= kWide;
  write_header(*header, is_wide);
  for (std::uint64_t i = 0; i < count && std::ferror(stdout) == 0; ++i) {
    check(laszip, laszip_read_point(laszip));
    write_point(*point, is_wide);
  }
  return 0;
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app(
      "Writes the points of a LAZ file as uncompressed LAS to standard output, for tern-mapper. Kept are position, "
      "class "
      "and flags. Exit code: 0 written, 2 bad options, a bad file, or the output cannot be written.",
      "tern-unlaz");
  app.set_version_flag("--version", fmt::format("tern-unlaz {}", tern::build_id()));
  std::string file;
  app.add_option("FILE", file, "LAZ or LAS file")->required();
  return tern::run_tool(app, "tern-unlaz", argc, argv, [&] { return tern::unlaz(file); });
}
