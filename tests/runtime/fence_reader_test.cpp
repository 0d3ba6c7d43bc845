// world.origin and world.fences.
#include "runtime/fence_reader.h"

#include <gtest/gtest.h>

#include "runtime/scenario_file.h"

namespace tern {
namespace {

constexpr char kWorld[] =
    "world:\n"
    "  origin: {latitude: 47.4, longitude: 8.5, height: 480}\n"
    "  fences:\n"
    "    - {name: a, corners: [[0, 0], [9, 0], [0, 9]], floor: 0, ceiling: 5}\n"
    "    - {kind: exclusion, coordinates: [[47.4, 8.5], [47.5, 8.5], [47.4, 8.6]]}\n"
    "    - {kind: exclusion, circle: {centre: [1, 2], radius: 3}}\n"
    "    - {circle: {latitude: 47.4, longitude: 8.5, radius: 100}, ceiling: 30}\n"
    "    - {file: site.plan, ceiling: 40}\n";

Scenario read(const std::string& yaml) {
  ConfigDocument document = ConfigDocument::parse(yaml, "a.yaml");
  return read_scenario(document);
}

std::string error_of(const std::string& fence) {
  try {
    (void)read("world:\n  fences:\n    - " + fence + "\n");
    return "";
  } catch (const ConfigError& e) {
    return e.what();
  }
}

TEST(FenceReader, ReadsEveryShape) {
  const WorldSpec world = read(kWorld).world;
  ASSERT_EQ(world.fences.size(), 4u);
  EXPECT_EQ(world.origin->height, 480.0);
  EXPECT_EQ(world.fences[0].ceiling, 5.0);
  EXPECT_TRUE(world.fences[1].is_geodetic);
  EXPECT_EQ(std::get<FenceCircle>(world.fences[2].shape).centre, Eigen::Vector2d(1, 2));
  EXPECT_EQ(std::get<FenceCircle>(world.fences[3].shape).centre, Eigen::Vector2d(47.4, 8.5));
  ASSERT_EQ(world.fence_files.size(), 1u);
  EXPECT_EQ(world.fence_files[0].ceiling, 40.0);
}

TEST(FenceReader, WhatIsWrittenIsReadBack) {
  const std::string once = write_scenario(read(kWorld));
  EXPECT_EQ(write_scenario(read(once)), once);
  EXPECT_NE(once.find("file: site.plan"), std::string::npos);
}

TEST(FenceReader, RefusesByKeyAndValue) {
  EXPECT_EQ(error_of("{name: a}"),
            "a.yaml:3: world.fences[0].kind: needs one shape: corners, coordinates, circle or file");
  EXPECT_EQ(error_of("{corners: [[0, 0], [1, 0]]}"), "a.yaml:3: world.fences[0].corners: 2 corners (limit 3 to 1000)");
  EXPECT_EQ(error_of("{corners: [[0, 0], [1, 1], [1, 0], [0, 1]]}"),
            "a.yaml:3: world.fences[0].corners: the polygon touches or crosses itself");
  EXPECT_EQ(error_of("{circle: {centre: [0], radius: 1}}"),
            "a.yaml:3: world.fences[0].circle.centre: 1 numbers (give x and y)");
  EXPECT_EQ(error_of("{circle: {centre: [0, 0], radius: 1}, floor: 2, ceiling: 2}"),
            "a.yaml:3: world.fences[0].ceiling: must be greater than floor");
  EXPECT_EQ(error_of("{circle: {latitude: 1, longitude: 2, radius: 1}}"),
            "a.yaml:3: world.fences[0].kind: has latitudes and longitudes, which need world.origin");
  EXPECT_EQ(error_of("{coordinates: [[91, 0], [1, 0], [0, 1]]}"),
            "a.yaml:3: world.fences[0].coordinates: latitude 91 is out of range [-90, 90]");
}

}  // namespace
}  // namespace tern
