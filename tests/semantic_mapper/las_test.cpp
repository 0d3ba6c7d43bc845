#include "semantic_mapper/sources/las.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using support::FileBytes;
using support::las_file;
using support::LasSpec;
using support::put;
using testing::HasSubstr;

const PointCloud kPoints{{Vec3(1.25, -2.5, 3.75), 2}, {Vec3(100.01, 20.02, -3.03), 6}, {Vec3(0, 0, 0), 31}};

std::string error_of(const FileBytes& bytes) {
  const auto cloud = parse_las(bytes, "scan.las", {});
  return cloud ? "" : cloud.error().message;
}

TEST(Las, ReadsEveryVersionAndFormat) {
  for (int minor = 0; minor <= 4; ++minor) {
    for (int format = 0; format <= (minor == 4 ? 10 : 5); ++format) {
      for (const int extra : {0, 7}) {
        SCOPED_TRACE(testing::Message() << "1." << minor << " format " << format << " extra " << extra);
        LasSpec spec;
        spec.minor = minor;
        spec.format = format;
        spec.extra_bytes = extra;
        const auto cloud = parse_las(las_file(kPoints, spec), "scan.las", {});
        ASSERT_TRUE(cloud) << cloud.error().message;
        ASSERT_EQ(cloud->points.size(), kPoints.size());
        for (std::size_t i = 0; i < kPoints.size(); ++i) {
          EXPECT_LT((cloud->points[i].position - kPoints[i].position).norm(), 1e-9);
          EXPECT_EQ(cloud->points[i].class_number, kPoints[i].class_number);
        }
      }
    }
  }
}

TEST(Las, AppliesScaleOffsetOriginAndUnit) {
  LasSpec spec;
  spec.scale = Vec3(0.01, 0.02, 0.001);
  spec.offset = Vec3(674521.92, 1206740.08, 627.53);
  const PointCloud points{{Vec3(674531.92, 1206760.08, 630.53), 6}};
  const PointFrame frame{Vec3(674521.92, 1206740.08, 627.53), 0.3048};
  const auto cloud = parse_las(las_file(points, spec), "scan.las", frame);
  ASSERT_TRUE(cloud);
  EXPECT_LT((cloud->points[0].position - Vec3(3.048, 6.096, 0.9144)).norm(), 1e-8);
}

TEST(Las, MasksFlagsAndLeavesOutWithheldPoints) {
  LasSpec spec;
  FileBytes bytes = las_file(kPoints, spec);
  bytes[227 + 15] = 2 | 0x20;       // synthetic
  bytes[227 + 34 + 15] = 6 | 0x80;  // withheld
  const auto cloud = parse_las(bytes, "scan.las", {});
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->points.size(), 2u);
  EXPECT_EQ(cloud->points[0].class_number, 2);
}

TEST(Las, NamesFileOffsetValueAndLimitOfWhatItRefuses) {
  const FileBytes good = las_file(kPoints, {});
  const auto with = [&](auto change) {
    FileBytes bytes = good;
    change(bytes);
    return error_of(bytes);
  };
  EXPECT_EQ(error_of(good), "");
  EXPECT_EQ(error_of({}), "scan.las, offset 0: the file ends within the header of 227 bytes");
  EXPECT_THAT(with([](FileBytes& b) { b[0] = 'X'; }), HasSubstr("offset 0: no LAS file"));
  EXPECT_THAT(with([](FileBytes& b) { b[25] = 5; }), HasSubstr("offset 24: LAS version 1.5 (limit 1.0 to 1.4)"));
  EXPECT_THAT(with([](FileBytes& b) { b[104] = 131; }),
              HasSubstr("offset 104: compressed (LAZ) points: decompress the file first, as by `pdal translate"));
  EXPECT_THAT(with([](FileBytes& b) { b[104] = 11; }), HasSubstr("offset 104: point format 11 (limit 0 to 10)"));
  EXPECT_THAT(with([](FileBytes& b) { put<std::uint16_t>(b, 105, 33); }),
              HasSubstr("records of 33 bytes (format 3 has at least 34)"));
  EXPECT_THAT(with([](FileBytes& b) { put<std::uint32_t>(b, 107, 4); }),
              HasSubstr("offset 107: 4 points, but the file ends after 3"));
  EXPECT_THAT(with([](FileBytes& b) { put<std::uint32_t>(b, 107, 0xffffffff); }),
              HasSubstr("4294967295 points (limit 50000000)"));
  EXPECT_THAT(with([](FileBytes& b) { put<std::uint32_t>(b, 96, 9999); }), HasSubstr("points begin at 9999"));
}

TEST(Las, LeavesOutAndCountsPointsThatCannotBeUsed) {
  FileBytes bytes = las_file(kPoints, {});
  put(bytes, 131, std::nan(""));
  EXPECT_EQ(parse_las(bytes, "scan.las", {})->not_finite, 3);
  bytes = las_file(kPoints, {});
  put(bytes, 155, 1e12);
  EXPECT_EQ(parse_las(bytes, "scan.las", {})->too_far, 3);
  EXPECT_TRUE(parse_las(bytes, "scan.las", {})->points.empty());
}

TEST(Las, TakesTheLegacyCountWhereTheWideOneIsZero) {
  LasSpec spec;
  spec.minor = 4;
  FileBytes bytes = las_file(kPoints, spec);
  put<std::uint64_t>(bytes, 247, 0);
  const auto cloud = parse_las(bytes, "scan.las", {});
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points.size(), kPoints.size());
}

}  // namespace
}  // namespace tern
