#include "semantic_mapper/sources/text_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/cloud_files.h"

namespace tern {
namespace {

using testing::HasSubstr;

Result<CloudFile> parse(const std::string& text, const std::string& label = "") {
  return parse_text_cloud({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "scan.xyz", {}, label);
}
std::string error_of(const std::string& text, const std::string& label = "") {
  const auto cloud = parse(text, label);
  return cloud ? "" : cloud.error().message;
}

TEST(TextCloud, ReadsNamedColumnsWithEverySeparator) {
  const PointCloud points{{Vec3(1.25, -2.5, 1e-3), 2}, {Vec3(465000.5, 5572094, 301), 255}};
  for (const char separator : {' ', '\t', ',', ';'}) {
    const auto cloud = parse_text_cloud(support::text_file(points, separator), "scan.xyz", {});
    ASSERT_TRUE(cloud) << cloud.error().message;
    EXPECT_TRUE(cloud->has_labels);
    ASSERT_EQ(cloud->points.size(), 1u);
    EXPECT_EQ(cloud->points[0].position, points[0].position);
    EXPECT_EQ(cloud->points[0].class_number, 2);
    EXPECT_EQ(cloud->too_far, 1);
  }
  const auto quoted = parse("\"X\",\"Y\",\"Z\",\"Classification\"\r\n1,2,3,6\r\n\r\n# end\n");
  ASSERT_TRUE(quoted) << quoted.error().message;
  EXPECT_EQ(quoted->points.at(0).class_number, 6);
}

TEST(TextCloud, WithoutNamesTakesThreeColumnsAndTheClassByItsNumber) {
  const std::string text = "1 2 3 200 6\n4 5 6 -1 2";
  const auto plain = parse(text);
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_FALSE(plain->has_labels);
  EXPECT_EQ(plain->points.at(1).position, Vec3(4, 5, 6));
  EXPECT_EQ(parse(text, "5")->points.at(0).class_number, 6);
  EXPECT_EQ(parse(text, "4")->not_a_class, 1);
  EXPECT_THAT(error_of(text, "6"), HasSubstr("offset 0: line 1: no column 6 for the class"));
  EXPECT_THAT(error_of(text, "label"), HasSubstr("no column label for the class"));
}

TEST(TextCloud, SkipsTheCountOfAPtsFileAndCountsWhatIsNotFinite) {
  const auto cloud = parse("3\n1 2 3 -700 1 2 3\nnan nan nan 0 0 0 0\n");
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->points.size(), 1u);
  EXPECT_EQ(cloud->not_finite, 1);
}

TEST(TextCloud, NamesLineAndOffsetOfWhatItRefuses) {
  EXPECT_THAT(error_of("1 2 3\n1 2\n"), HasSubstr("scan.xyz, offset 6: line 2: 2 numbers in a line, but 3 columns"));
  EXPECT_THAT(error_of("1 2 3\n1 2 x\n"), HasSubstr("line 2: \"x\" is not a number"));
  EXPECT_THAT(error_of("1 2\n"), HasSubstr("2 numbers in a line (a point has at least 3)"));
  EXPECT_THAT(error_of("a b c\n1 2 3\n"), HasSubstr("no property x among a, b, c"));
  EXPECT_THAT(error_of("x y z\n1 2 3\n", "sem"), HasSubstr("no property sem for the class among x, y, z"));
  std::string columns;
  for (std::size_t i = 0; i <= kMaxTextColumns; ++i) columns += "1 ";
  EXPECT_THAT(error_of(columns), HasSubstr("line 1: more than 256 columns"));
  EXPECT_THAT(error_of("1 2 3\n" + std::string(kMaxTextLine, '1') + "1"),
              HasSubstr("line 2: 65537 bytes (limit 65536)"));
  EXPECT_EQ(error_of("#" + std::string(kMaxTextLine, '1') + "\n1 2 3"), "");
  EXPECT_EQ(error_of(""), "") << "no points; the report of the cloud refuses it";
}

}  // namespace
}  // namespace tern
