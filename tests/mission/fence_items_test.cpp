// Items of uploaded fences as fences.
#include "mission/upload/fence_items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/world/fence_set.h"
#include "mission/upload/mission_server.h"
#include "semantic_mapper/sources/fence_file.h"
#include "tests/mission/some_site.h"
#include "tests/mission/station_link.h"

namespace tern::mission {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using Wire = std::vector<mavlink::MissionItemInt>;

Result<std::vector<Fence>> read(Wire wire, const Site& site = site_without_origin()) {
  std::vector<Item> items;
  for (std::size_t k = 0; k < wire.size(); ++k) {
    wire[k].seq = static_cast<std::uint16_t>(k);
    items.push_back(item_of(wire[k]));
  }
  return fences_of(items, site);
}

std::string refusal(const Wire& wire) {
  const auto fences = read(wire);
  return fences ? "accepted" : fences.error().message;
}

Wire joined(Wire wire, const Wire& more) {
  wire.insert(wire.end(), more.begin(), more.end());
  return wire;
}

TEST(FenceItems, ArePolygonsAndCirclesToStayInAndOutOf) {
  const auto fences =
      read(joined(joined(rectangle(kPolygonInclusion, 0, 0, 9, 8), rectangle(kPolygonExclusion, 2, 2, 3, 3)),
                  {fence_item(kCircleInclusion, 5.0F, 4, 4), fence_item(kCircleExclusion, 1.5F, 6, 6)}))
          .value();
  ASSERT_EQ(fences.size(), 4u);
  for (const auto& [k, is_inclusion] :
       {std::pair{0, true}, std::pair{1, false}, std::pair{2, true}, std::pair{3, false}})
    EXPECT_EQ(fences[idx(k)].is_inclusion, is_inclusion);
  EXPECT_THAT(std::get<FencePolygon>(fences[0].shape).corners,
              ::testing::ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(9, 0), Eigen::Vector2d(9, 8),
                                     Eigen::Vector2d(0, 8)));
  EXPECT_EQ(std::get<FenceCircle>(fences[3].shape).radius, 1.5);
  for (const Fence& fence : fences) EXPECT_TRUE(std::isinf(fence.floor) && std::isinf(fence.ceiling));
}

/// The fences of some_site's plan, as QGroundControl uploads them: in frame 0, without autocontinue.
TEST(FenceItems, MeanTheSameAsThoseOfAPlan) {
  Wire wire;
  for (const auto& [latitude, longitude] :
       {std::pair{47.3972, 8.5450}, std::pair{47.3972, 8.5465}, std::pair{47.3985, 8.5465}, std::pair{47.3985, 8.5450}})
    wire.push_back(fence_item(kPolygonInclusion, 4, latitude, longitude, 0));
  wire.push_back(fence_item(kCircleExclusion, 5, 47.3980, 8.5460, 0));
  const auto uploaded = read(wire, some_site()).value();
  const auto planned = parse_fences(kPlan, "a.plan").value();
  ASSERT_EQ(uploaded.size(), planned.size());
  for (std::size_t k = 0; k < planned.size(); ++k) {
    const Fence fence = to_world(planned[k], *some_site().frame).value();
    EXPECT_EQ(uploaded[k].is_inclusion, fence.is_inclusion);
    ASSERT_EQ(uploaded[k].shape.index(), fence.shape.index());
  }
  const Fence circle = to_world(planned[1], *some_site().frame).value();
  EXPECT_LT((std::get<FenceCircle>(uploaded[1].shape).centre - std::get<FenceCircle>(circle.shape).centre).norm(),
            0.02);
  const Fence polygon = to_world(planned[0], *some_site().frame).value();
  for (std::size_t k = 0; k < 4; ++k) {
    const auto corner = [k](const Fence& fence) { return std::get<FencePolygon>(fence.shape).corners[k]; };
    EXPECT_LT((corner(uploaded[0]) - corner(polygon)).norm(), 0.02);
  }
}

TEST(FenceItems, AReturnPointIsNoFence) {
  EXPECT_TRUE(read({fence_item(kReturnPoint, 0, 1, 1)}).value().empty());
  EXPECT_EQ(
      read(joined(rectangle(kPolygonInclusion, 0, 0, 9, 8), {fence_item(kReturnPoint, 0, 1, 1, 3)})).value().size(),
      1u);
}

TEST(FenceItems, WhatCannotBeHonouredIsRefusedByName) {
  EXPECT_THAT(refusal({fence_item(16, 0, 1, 1)}), HasSubstr("fence item 1, MAV_CMD_NAV_WAYPOINT (16): is no fence"));
  EXPECT_THAT(refusal({fence_item(5100, 0, 1, 1)}), HasSubstr("MAV_CMD_NAV_RALLY_POINT (5100): is no fence"));
  EXPECT_THAT(refusal({fence_item(kCircleExclusion, 0, 1, 1)}), HasSubstr("a radius of 0 m is not in (0, 100000] m"));
  EXPECT_THAT(refusal({fence_item(kCircleExclusion, NAN, 1, 1)}), HasSubstr("a radius of nan m"));
  EXPECT_THAT(refusal({fence_item(kCircleExclusion, 5, 1, 1, 10)}), HasSubstr("frame 10 is not supported"));
  EXPECT_THAT(refusal({fence_item(kCircleExclusion, 5, 47.4, 8.5, 0)}), HasSubstr("no origin"));
  EXPECT_THAT(refusal({fence_item(kCircleExclusion, 5, 2e5, 0)}), HasSubstr("farther than 100000 m from the origin"));
  EXPECT_THAT(read({fence_item(kCircleExclusion, 5, -47.4, 8.5, 0)}, some_site()).error().message,
              HasSubstr("from the origin"));
  Wire grouped{fence_item(kCircleInclusion, 5, 1, 1)};
  grouped[0].param[1] = 2.0F;
  EXPECT_THAT(refusal(grouped), HasSubstr("groups of inclusions (param2 = 2)"));
}

TEST(FenceItems, APolygonHasAllItsCorners) {
  Wire wire = rectangle(kPolygonInclusion, 0, 0, 9, 8);
  wire.pop_back();
  EXPECT_EQ(refusal(wire), "the last polygon lacks 1 corners");
  EXPECT_THAT(
      refusal(joined(wire, rectangle(kPolygonExclusion, 1, 1, 2, 2))),
      HasSubstr("fence item 4, MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION (5002): 1 corners of the polygon before "
                "are missing"));
  EXPECT_THAT(refusal(joined(wire, {fence_item(kReturnPoint, 0, 1, 1)})), HasSubstr("1 corners of the polygon before"));
  wire[2].param[0] = 5.0F;
  EXPECT_THAT(refusal(wire), HasSubstr("5 corners, and 4 at the first one"));
  for (const float count : {0.0F, 2.0F, 3.5F, 1e9F, -1.0F, NAN})
    EXPECT_THAT(refusal({fence_item(kPolygonInclusion, count, 1, 1)}), HasSubstr("corners (limit 3 to 1000)")) << count;
}

TEST(FenceItems, AreAsManyAsAMessageHolds) {
  const Wire most(kMaxFencesPerMessage, fence_item(kCircleExclusion, 1, 1, 1));
  EXPECT_EQ(refusal(most), "accepted");
  EXPECT_THAT(refusal(joined(most, {most[0]})), HasSubstr("more than 1000 fences"));
  const Wire corners(kMaxFenceCornersPerMessage, fence_item(kPolygonInclusion, kMaxFenceCornersPerMessage, 1, 1));
  EXPECT_EQ(refusal(corners), "accepted");
  EXPECT_THAT(refusal(joined(corners, rectangle(kPolygonInclusion, 0, 0, 1, 1))), HasSubstr("more than 1000 corners"));
}

}  // namespace
}  // namespace tern::mission
