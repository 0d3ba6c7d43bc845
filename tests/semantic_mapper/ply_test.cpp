#include "semantic_mapper/sources/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using support::FileBytes;
using support::ply_file;
using support::PlyKind;
using testing::HasSubstr;

const PointCloud kPoints{{Vec3(1.25, -2.5, 3.75), 2}, {Vec3(100.01, 1e-5, -3.5), 255}, {Vec3(0, 0, 0), 0}};
constexpr PlyKind kKinds[] = {PlyKind::Ascii, PlyKind::Little, PlyKind::Big};

Result<CloudFile> parse(const std::string& text) {
  return parse_ply({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "cloud.ply", {});
}

std::string error_of(const std::string& text) {
  const auto cloud = parse(text);
  return cloud ? "" : cloud.error().message;
}

/// A header around some lines.
std::string with_lines(const std::string& lines, const std::string& data = "1 2 3\n") {
  return "ply\nformat ascii 1.0\nelement vertex 1\n" + lines + "end_header\n" + data;
}
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

TEST(Ply, ReadsEveryKindExactly) {
  for (const PlyKind kind : kKinds) {
    for (const char* name : {"label", "class", "classification", "scalar_Classification"}) {
      const auto cloud = parse_ply(ply_file(kPoints, kind, name), "cloud.ply", {});
      ASSERT_TRUE(cloud) << cloud.error().message;
      ASSERT_EQ(cloud->points.size(), kPoints.size());
      for (std::size_t i = 0; i < kPoints.size(); ++i) {
        EXPECT_EQ(cloud->points[i].position, kPoints[i].position);
        EXPECT_EQ(cloud->points[i].class_number, kPoints[i].class_number);
      }
    }
  }
}

TEST(Ply, SaysThatThereIsNoClassPropertyAndWhichThereAre) {
  const auto cloud = parse_ply(ply_file(kPoints, PlyKind::Little, "brightness"), "cloud.ply", {});
  ASSERT_TRUE(cloud);
  EXPECT_FALSE(cloud->has_labels);
  EXPECT_THAT(cloud->properties, testing::Contains("brightness"));
  for (const LabelledPoint& point : cloud->points) EXPECT_EQ(point.class_number, 0);
}

TEST(Ply, TakesTheClassFromThePropertyThatIsNamed) {
  const std::string lines = kXyz + "property uint label\nproperty uint Class\n";
  const std::string text = with_lines(lines, "1 2 3 70000 6\n");
  const auto parse_by = [&](const std::string& label) {
    return parse_ply({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "cloud.ply", {}, label);
  };
  ASSERT_TRUE(parse_by("class"));
  ASSERT_EQ(parse_by("class")->points.size(), 1u);
  EXPECT_EQ(parse_by("class")->points[0].class_number, 6);
  EXPECT_EQ(parse_by("")->not_a_class, 1);
  ASSERT_FALSE(parse_by("sem_class"));
  EXPECT_THAT(parse_by("sem_class").error().message,
              HasSubstr("no property sem_class for the class among x, y, z, label, Class"));
}

TEST(Ply, LeavesOutAndCountsVerticesThatCannotBeUsed) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 6\n" + kXyz + "property float label\nend_header\n";
  const auto cloud = parse(header + "1 2 3 6\n1 2 nan 6\n1 inf 3 6\n1 2 3 -1\n1 2 3 1.5\n1 2 2e7 6\n");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points.size(), 1u);
  EXPECT_EQ(cloud->not_finite, 2);
  EXPECT_EQ(cloud->not_a_class, 2);
  EXPECT_EQ(cloud->too_far, 1);
}

TEST(Ply, SaysHowFarApartItsFloat32CoordinatesLie) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz + "end_header\n";
  const std::string text = header + "465000 5572094 301\n";
  const auto cloud = parse_ply({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "cloud.ply",
                               {Vec3(465000, 5572094, 300), 2.0});
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->spacing, 1.0) << "0.5 units of 2 m";
}

TEST(Ply, AppliesOriginAndUnit) {
  const auto cloud = parse_ply(ply_file(kPoints, PlyKind::Ascii), "cloud.ply", {Vec3(1, 0, 0), 2.0});
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->points[0].position, Vec3(0.5, -5.0, 7.5));
}

TEST(Ply, TakesCarriageReturnsPlusSignsAndNoLastNewline) {
  const auto cloud = parse("ply\r\nformat ascii 1.0\r\nelement vertex 1\r\n" + kXyz + "end_header\r\n+1.5 -2e0\t3");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points[0].position, Vec3(1.5, -2, 3));
}

TEST(Ply, NamesFileOffsetValueAndLimitOfWhatItRefuses) {
  EXPECT_EQ(error_of(with_lines(kXyz)), "");
  EXPECT_THAT(error_of(""), HasSubstr("cloud.ply, offset 0: no PLY header"));
  EXPECT_THAT(error_of("plyx\nformat"), HasSubstr("offset 0: no PLY file"));
  EXPECT_THAT(error_of("ply\nformat ascii 2.0\nend_header\n"), HasSubstr("offset 4: the format line"));
  EXPECT_THAT(error_of("ply\nformat text 1.0\nend_header\n"), HasSubstr("unknown format text"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no element vertex"));
  EXPECT_THAT(error_of("ply\nelement vertex 1\n" + kXyz + "end_header\n1 2 3"), HasSubstr("no format line"));
  EXPECT_THAT(error_of(with_lines("property float x\n")), HasSubstr("no property y"));
  EXPECT_THAT(error_of(with_lines(kXyz + "property float x\n")), HasSubstr("property x given twice"));
  EXPECT_THAT(error_of(with_lines(kXyz + "property list uchar int l\n")), HasSubstr("a list property in a vertex"));
  EXPECT_THAT(error_of(with_lines(kXyz + "property quad q\n")), HasSubstr("unknown type quad"));
  EXPECT_THAT(error_of(with_lines(kXyz, "1 2\n   ")), HasSubstr("no number where point 0 needs one"));
  EXPECT_THAT(error_of(with_lines(kXyz, "1 2 3x\n")), HasSubstr("no number where point 0 needs one"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement face 1\nend_header\n"), HasSubstr("element face before vertex"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 60000000\nend_header\n"),
              HasSubstr("60000000 vertices (limit 50000000)"));
  EXPECT_THAT(error_of("ply\nformat binary_little_endian 1.0\nelement vertex 2\n" + kXyz + "end_header\n0123456789ab"),
              HasSubstr("2 vertices, but the file ends after 1"));
  EXPECT_THAT(error_of("ply\nformat ascii 1.0\nelement vertex 49999999\n" + kXyz + "end_header\n1 2 3\n"),
              HasSubstr("has room for 1"));
}

}  // namespace
}  // namespace tern
