// tern-unlaz and LASzip: a LAZ file gives the points of the LAS file that it was made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <laszip/laszip_api.h>

#include <filesystem>
#include <fstream>

#include "core/base/plain_text.h"
#include "core/base/random.h"
#include "runtime/scenario_file.h"
#include "semantic_mapper/app/laz.h"
#include "semantic_mapper/app/load_map.h"
#include "semantic_mapper/app/load_source.h"
#include "semantic_mapper/sources/las.h"
#include "tests/support/cloud_files.h"
#include "tests/support/effort.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

using support::FileBytes;
using support::LasSpec;

/// Compresses a LAS file. @param for_old_readers  formats 6–10 as 1–5, as LASzip wrote them before version 3
void compress(const std::string& las, const std::string& laz, bool for_old_readers = false) {
  laszip_POINTER reader = nullptr, writer = nullptr;
  laszip_header_struct* header = nullptr;
  laszip_point_struct* point = nullptr;
  laszip_BOOL is_compressed = 0;
  int failed = laszip_create(&reader) | laszip_create(&writer) |
               laszip_open_reader(reader, las.c_str(), &is_compressed) | laszip_get_header_pointer(reader, &header) |
               laszip_get_point_pointer(reader, &point) | laszip_set_header(writer, header) |
               laszip_request_compatibility_mode(writer, for_old_readers ? 1 : 0) |
               laszip_request_native_extension(writer, for_old_readers ? 0 : 1) | laszip_set_chunk_size(writer, 100) |
               laszip_open_writer(writer, laz.c_str(), 1);
  const std::uint64_t count =
      std::max<std::uint64_t>(header->number_of_point_records, header->extended_number_of_point_records);
  for (std::uint64_t i = 0; i < count && failed == 0; ++i) {
    failed = laszip_read_point(reader) | laszip_set_point(writer, point) | laszip_write_point(writer);
  }
  laszip_CHAR* reason = nullptr;
  laszip_get_error(writer, &reason);
  ASSERT_EQ(failed, 0) << reason;
  ASSERT_EQ(laszip_close_writer(writer) | laszip_close_reader(reader), 0);
  laszip_destroy(writer);
  laszip_destroy(reader);
}

/// Points of all classes. In formats 0–5 the upper bits of this byte are flags.
FileBytes some_las(Rng& rng, const LasSpec& spec, int count) {
  PointCloud points;
  for (int i = 0; i < count; ++i) {
    const Vec3 p(rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-5, 5));
    points.push_back({p, static_cast<std::uint8_t>(rng.uniform(0, 256))});
  }
  return support::las_file(points, spec);
}

/// A temporary folder with files.
class Unlaz : public ::testing::Test {
 protected:
  void write(const std::string& name, const FileBytes& bytes) const {
    std::ofstream(folder_.file(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  }
  [[nodiscard]] FileBytes read(const std::string& name) const {
    std::ifstream stream(folder_.file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] Result<FileBytes> unlaz(const std::string& name) const {
    return decompress_laz(folder_.file(name), unlaz_program(), kMaxCloudBytes);
  }
  [[nodiscard]] VoxelMap map_of(const std::string& file) const {
    auto document = ConfigDocument::parse("mapper: {sources: [{file: " + file + "}]}", folder_.file("s.yaml"));
    const Scenario scenario = read_scenario(document);
    return load_map(scenario, read_mapper_config(document.root().section("mapper")), nullptr).map;
  }

  TempFolder folder_;
};
using HostileLaz = Unlaz;

void expect_equal(const CloudFile& cloud, const CloudFile& expected) {
  ASSERT_EQ(cloud.points.size(), expected.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    ASSERT_EQ(cloud.points[i].position, expected.points[i].position);
    ASSERT_EQ(cloud.points[i].class_number, expected.points[i].class_number);
  }
}

TEST_F(Unlaz, GivesThePointsOfTheUncompressedFile) {
  Rng rng(1);
  for (const int minor : {0, 2, 3, 4}) {
    for (int format = 0; format <= (minor == 4 ? 10 : minor == 3 ? 5 : 3); ++format) {
      for (const int extra : {0, 7}) {
        for (const bool for_old_readers : {false, true}) {
          if (for_old_readers && format < 6) continue;
          SCOPED_TRACE(testing::Message()
                       << "1." << minor << " format " << format << " extra " << extra << " old " << for_old_readers);
          LasSpec spec{.minor = minor, .format = format, .extra_bytes = extra, .scale = Vec3(0.01, 0.02, 0.003)};
          spec.offset = Vec3(674521.92, 1206740.08, 627.53);
          const FileBytes las = some_las(rng, spec, 350);
          write("town.las", las);
          ASSERT_NO_FATAL_FAILURE(compress(folder_.file("town.las"), folder_.file("town.laz"), for_old_readers));
          ASSERT_TRUE(is_compressed_las(read("town.laz")));
          const auto bytes = unlaz("town.laz");
          ASSERT_TRUE(bytes) << bytes.error().message;
          const auto cloud = parse_las(*bytes, "file", {}), expected = parse_las(las, "file", {});
          ASSERT_TRUE(cloud) << cloud.error().message;
          ASSERT_TRUE(expected) << expected.error().message;
          ASSERT_NO_FATAL_FAILURE(expect_equal(*cloud, *expected));
        }
      }
    }
  }
}

TEST_F(Unlaz, ALazSourceGivesTheMapOfItsLasFile) {
  Rng rng(2);
  write("town.las", some_las(rng, {}, 2000));
  ASSERT_NO_FATAL_FAILURE(compress(folder_.file("town.las"), folder_.file("town.laz")));
  const VoxelMap las = map_of("town.las"), laz = map_of("town.laz");
  EXPECT_EQ(laz.labels, las.labels);
  EXPECT_EQ(laz.version, las.version);
  EXPECT_GT(std::count(las.labels.begin(), las.labels.end(), VoxelLabel::Occupied), 100);
}

TEST_F(Unlaz, NamesFileAndReasonOfWhatItRefuses) {
  Rng rng(3);
  write("town.las", some_las(rng, {}, 350));
  ASSERT_NO_FATAL_FAILURE(compress(folder_.file("town.las"), folder_.file("town.laz")));
  const FileBytes good = read("town.laz");
  const auto error_of = [&](auto change) {
    FileBytes bytes = good;
    change(bytes);
    write("bad.laz", bytes);
    const auto result = unlaz("bad.laz");
    return result ? "" : result.error().message;
  };
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_EQ(error_of([](FileBytes&) {}), "");
  EXPECT_THAT(error_of([](FileBytes& b) { b[0] = 'X'; }),
              StartsWith(folder_.file("bad.laz") + ": tern-unlaz: LASzip: "));
  EXPECT_THAT(error_of([](FileBytes& b) { b.resize(b.size() / 2); }), HasSubstr("reading point"));
  EXPECT_THAT(error_of([](FileBytes& b) { support::put<std::uint32_t>(b, 107, 1000); }), HasSubstr("of 1000 total"));
  EXPECT_THAT(error_of([](FileBytes& b) { support::put<std::uint32_t>(b, 107, 0xffffffff); }),
              HasSubstr("4294967295 points (limit 50000000)"));
}

TEST_F(HostileLaz, MutatedFilesGiveAValueOrAnError) {
  Rng rng(4);
  const int mutations = support::at_effort(500);
  int clouds = 0, errors = 0;
  for (int i = 0; i < mutations; ++i) {
    LasSpec spec;
    spec.minor = i % 2 == 0 ? 2 : 4;
    spec.format = spec.minor == 4 ? i % 11 : i % 4;
    write("town.las", some_las(rng, spec, 150));
    ASSERT_NO_FATAL_FAILURE(compress(folder_.file("town.las"), folder_.file("town.laz"), i % 5 == 0));
    write("bad.laz", support::mutated(read("town.laz"), rng));
    const auto bytes = unlaz("bad.laz");
    const auto cloud = bytes ? parse_las(*bytes, "file", {}) : tl::unexpected(bytes.error());
    ++(cloud ? clouds : errors);
    if (cloud) continue;
    ASSERT_FALSE(cloud.error().message.empty());
    ASSERT_LT(cloud.error().message.size(), 400u);
    ASSERT_TRUE(is_plain_text(cloud.error().message));
  }
  EXPECT_GT(clouds, 0);
  EXPECT_GT(errors, 0);
}

}  // namespace
}  // namespace tern
