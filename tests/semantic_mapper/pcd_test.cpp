#include "semantic_mapper/sources/pcd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/base/random.h"
#include "semantic_mapper/sources/lzf.h"
#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using support::FileBytes;
using support::pcd_file;
using support::PcdKind;
using testing::HasSubstr;

const PointCloud kPoints{{Vec3(1.25, -2.5, 3.75), 2}, {Vec3(100, 0.5, -3.5), 255}, {Vec3(0, 0, 0), 0}};
constexpr PcdKind kKinds[] = {PcdKind::Ascii, PcdKind::Binary, PcdKind::Compressed};

Result<CloudFile> parse(const std::string& text, const std::string& label = "") {
  return parse_pcd({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "cloud.pcd", {}, label);
}
std::string error_of(const std::string& text) {
  const auto cloud = parse(text);
  return cloud ? "" : cloud.error().message;
}

FileBytes golden(const std::string& name) {
  std::ifstream stream(TERN_MAP_GOLDEN "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Pcd, ReadsEveryKindExactly) {
  for (const PcdKind kind : kKinds) {
    for (const char* name : {"label", "Classification"}) {
      const auto cloud = parse_pcd(pcd_file(kPoints, kind, name), "cloud.pcd", {});
      ASSERT_TRUE(cloud) << cloud.error().message;
      ASSERT_EQ(cloud->points.size(), kPoints.size());
      EXPECT_TRUE(cloud->has_labels);
      for (std::size_t i = 0; i < kPoints.size(); ++i) {
        EXPECT_EQ(cloud->points[i].position, kPoints[i].position);
        EXPECT_EQ(cloud->points[i].class_number, kPoints[i].class_number);
      }
    }
  }
}

TEST(Pcd, ReadsTheFilesOfThePointCloudLibrary) {
  const auto text = parse_pcd(golden("pcl_ascii.pcd"), "pcl_ascii.pcd", {});
  ASSERT_TRUE(text) << text.error().message;
  ASSERT_EQ(text->points.size(), 300u);
  EXPECT_EQ(text->not_finite, 2);
  for (const char* name : {"pcl_binary.pcd", "pcl_compressed.pcd"}) {
    const auto cloud = parse_pcd(golden(name), name, {});
    ASSERT_TRUE(cloud) << cloud.error().message;
    EXPECT_EQ(cloud->not_finite, 2);
    ASSERT_EQ(cloud->points.size(), 300u);
    for (std::size_t i = 0; i < cloud->points.size(); ++i) {
      EXPECT_EQ(cloud->points[i].position.cast<float>(), text->points[i].position.cast<float>());
      EXPECT_EQ(cloud->points[i].class_number, text->points[i].class_number);
    }
  }
}

TEST(Pcd, WithoutAClassHasNoLabelsAndTakesTheFieldThatIsNamed) {
  const FileBytes bytes = pcd_file(kPoints, PcdKind::Compressed, "intensity");
  const auto plain = parse_pcd(bytes, "cloud.pcd", {});
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->has_labels);
  EXPECT_THAT(plain->properties, testing::Contains("intensity"));
  EXPECT_EQ(parse_pcd(bytes, "cloud.pcd", {}, "intensity")->points[1].class_number, 255);
  EXPECT_THAT(parse_pcd(bytes, "cloud.pcd", {}, "sem").error().message,
              HasSubstr("no property sem for the class among x, y, z, _"));
  for (const PcdKind kind : kKinds) {
    EXPECT_THAT(parse_pcd(pcd_file(kPoints, kind), "cloud.pcd", {}, "_").error().message,
                HasSubstr("the field _ is padding"));
  }
}

TEST(Pcd, LeavesOutAndCountsInvalidPixelsAndSaysThatTheViewpointIsNotApplied) {
  const std::string header =
      "FIELDS x y z\r\nSIZE 8 8 8\r\nTYPE F F F\r\nWIDTH 2\r\nHEIGHT 2\r\nVIEWPOINT 0 0 1 1 0 0 0\r\nDATA ascii\r\n";
  const auto cloud = parse(header + "1 2 3\r\nnan nan nan\r\n-nan 1 2\r\n4 5 2e7");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points.size(), 1u);
  EXPECT_EQ(cloud->not_finite, 2);
  EXPECT_EQ(cloud->too_far, 1);
  EXPECT_THAT(cloud->warning, HasSubstr("VIEWPOINT"));
}

TEST(Pcd, NamesFileOffsetValueAndLimitOfWhatItRefuses) {
  const auto header = [](const std::string& lines, const std::string& data = "DATA ascii\n1 2 3\n") {
    return "VERSION .7\nFIELDS x y z\n" + lines + data;
  };
  const std::string types = "SIZE 4 4 4\nTYPE F F F\n";
  const std::string one = types + "WIDTH 1\nHEIGHT 1\nPOINTS 1\n";
  EXPECT_EQ(error_of(header(one)), "");
  EXPECT_EQ(error_of(header(types + "POINTS 1\n")), "");
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\n"), HasSubstr("cloud.pcd, offset 0: no PCD file"));
  EXPECT_THAT(error_of(header(one, "")), HasSubstr("no line DATA within"));
  EXPECT_THAT(error_of(header(one, "DATA zip\n")), HasSubstr("is not ascii, binary or binary_compressed"));
  EXPECT_THAT(error_of(header("SIZE 4 4\nTYPE F F F\nPOINTS 1\n")), HasSubstr("3 fields, but 2 sizes, 3 types"));
  EXPECT_THAT(error_of(header("SIZE 4 4 3\nTYPE F F F\nPOINTS 1\n")), HasSubstr("no type F of 3 bytes"));
  EXPECT_THAT(error_of(header(types + "COUNT 1 1 2000\nPOINTS 1\n")), HasSubstr("more than 1024 numbers per point"));
  EXPECT_THAT(error_of(header(types + "WIDTH 2\nHEIGHT 1\nPOINTS 1\n")),
              HasSubstr("POINTS 1, but WIDTH × HEIGHT is 2"));
  EXPECT_THAT(error_of(header(types + "WIDTH 99999999999\nHEIGHT 99999999999\n")), HasSubstr("(limit 50000000)"));
  EXPECT_THAT(error_of(header(types + "POINTS 50000001\n")), HasSubstr("50000001 × 1 points (limit 50000000)"));
  EXPECT_THAT(error_of(header(types)), HasSubstr("neither POINTS nor WIDTH and HEIGHT"));
  EXPECT_THAT(error_of(header(types + "POINTS 49999999\n")), HasSubstr("has room for 1"));
  EXPECT_THAT(error_of(header(one, "DATA ascii\n1 2       \n")), HasSubstr("no number where point 0 needs one"));
  EXPECT_THAT(error_of(header(one, "DATA binary\n12345678901")), HasSubstr("1 points, but the file ends after 0"));
  EXPECT_THAT(error_of(header(one, "DATA binary_compressed\n1234")), HasSubstr("ends before the compressed data"));
  const std::string long_data(
      "\x09\0\0\0\x0c\0\0\0\x07"
      "12345678",
      17);
  EXPECT_THAT(error_of(header(one, "DATA binary_compressed\n" + long_data)),
              HasSubstr("do not decompress to 12 bytes"));
  EXPECT_THAT(error_of("FIELDS x y y\n" + one + "DATA ascii\n1 2 3\n"), HasSubstr("field y given twice"));
  EXPECT_THAT(error_of("FIELDS a y z\n" + one + "DATA ascii\n1 2 3\n"), HasSubstr("no property x among a, y, z"));
}

TEST(Lzf, GivesBackWhatWasCompressed) {
  Rng rng(1);
  for (int n = 1; n < 300; ++n) {
    FileBytes bytes;
    while (std::ssize(bytes) < 7 * n) {
      bytes.insert(bytes.end(), static_cast<std::size_t>(rng.uniform(1, 400)),
                   static_cast<std::uint8_t>(rng.uniform(0, 4)));
      bytes.push_back(static_cast<std::uint8_t>(rng.uniform(0, 256)));
    }
    const FileBytes packed = support::lzf_compressed(bytes);
    EXPECT_EQ(lzf_decompress(packed, bytes.size()), bytes);
    EXPECT_FALSE(lzf_decompress(packed, bytes.size() + 1));
    EXPECT_FALSE(lzf_decompress(packed, bytes.size() - 1));
  }
}

TEST(Lzf, CopiesFromADistance) {
  const FileBytes stream{2, 'a', 'b', 'c', 2 << 5, 2, 7 << 5, 3, 1};  // "abc", 4 bytes from 3 back, 12 from 2 back
  const auto bytes = lzf_decompress(stream, 19);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(std::string(bytes->begin(), bytes->begin() + 7), "abcabca");
  EXPECT_EQ(std::string(bytes->begin() + 7, bytes->end()), "cacacacacaca");
  EXPECT_FALSE(lzf_decompress(FileBytes{2 << 5, 0}, 4)) << "nothing to copy yet";
  EXPECT_FALSE(lzf_decompress(FileBytes{}, std::size_t{1} << 60)) << "no memory is allocated";
}

}  // namespace
}  // namespace tern
