// Depth pictures with their sightings, and unseen cells, as the page gets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "perception/view.h"
#include "viewer/bridge/scene.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

using Json = nlohmann::json;

constexpr UTime kNow{5'000'000};
/// Turns x right, y down, z forward into W with z along x.
const Eigen::Vector4d kAhead(0.5, -0.5, 0.5, -0.5);

/// A camera at (0, 0, 1) that looks along x, with 2 × 3 cells and 10 m of range.
SightingSet frame(UTime at, std::vector<std::int16_t> depths) {
  SightingSet set;
  set.at = at;
  set.sensor_id = 4;
  set.view.sensor_position = Vec3(0, 0, 1);
  set.view.q_WC = kAhead;
  set.view.left = set.view.right = std::numbers::pi / 4;
  set.view.up = set.view.down = std::atan(0.5);
  set.view.range_m = 10.0;
  set.view.rows = 2;
  set.view.columns = 3;
  set.view.depths = std::move(depths);
  return set;
}

UavState state(UTime at) {
  UavState state;
  state.at = at;
  state.motion.p = Vec3(0, 0, 1);
  return state;
}

using Cells = std::set<std::pair<int, int>>;

Cells cells_of(const std::vector<SeenCells::Run>& runs) {
  Cells cells;
  for (const auto& [x, y, count] : runs) {
    for (int k = 0; k < count; ++k) cells.emplace(x + k, y);
  }
  return cells;
}

TEST(SightOfAScene, HasDepthsInDecimetresAndBoundsOfEachSighting) {
  Scene scene;
  EXPECT_EQ(sight_json(scene), "null");
  SightingSet set = frame(kNow, {kBlindDepth, 1, 234, 999, 500, kFarDepth});
  Sighting sighting;
  sighting.lower = Vec3(3, -1, 0);
  sighting.upper = Vec3(3.2, 1, 2);
  sighting.bounds = {BoundSight::Face, BoundSight::Unseen,   BoundSight::Occluded,
                     BoundSight::Cut,  BoundSight::Touching, BoundSight::Whole};
  set.sightings.push_back(sighting);
  scene.receive(set);
  EXPECT_TRUE(scene.take_change(Topic::Sight));
  const Json json = Json::parse(sight_json(scene));
  ASSERT_EQ(json["sensors"].size(), 1U);
  const Json& sensor = json["sensors"][0];
  EXPECT_EQ(json["at_us"], kNow.us);
  EXPECT_EQ(sensor["sensor"], 4);
  EXPECT_EQ(sensor["kind"], "camera");
  EXPECT_EQ(sensor["at_us"], kNow.us);
  EXPECT_EQ(sensor["depths"], Json({0, 1, 23, 100, 50, -1}));
  EXPECT_EQ(sensor["lower"], Json({3, -1, 0}));
  EXPECT_EQ(sensor["upper"], Json({3.2, 1, 2}));
  EXPECT_EQ(sensor["bounds"], Json({0, 5, 2, 3, 4, 1}));
  EXPECT_FALSE(json.contains("unseen")) << "nobody knows where the vehicle is";
}

TEST(SightOfAScene, ChangesWithTheVehiclesTimeSoAPictureThatGetsOldIsUnseen) {
  Scene scene;
  scene.receive(state(kNow));
  EXPECT_FALSE(scene.take_change(Topic::Sight)) << "no sensor has a view";
  scene.receive(frame(kNow, std::vector<std::int16_t>(6, kFarDepth)));
  const auto count = [](const Json& json) {
    int cells = 0;
    const Json& runs = json["unseen"]["runs"];
    for (std::size_t k = 2; k < runs.size(); k += 3) cells += runs[k].get<int>();
    return cells;
  };
  const int all = SeenCells::kShown * SeenCells::kShown;
  EXPECT_LT(count(Json::parse(sight_json(scene))), all * 9 / 10);
  EXPECT_TRUE(scene.take_change(Topic::Sight));
  scene.receive(state(kNow + Duration{1'100'000}));
  EXPECT_TRUE(scene.take_change(Topic::Sight));
  const Json later = Json::parse(sight_json(scene));
  EXPECT_EQ(count(later), all);
  EXPECT_EQ(later["at_us"].get<std::int64_t>() - later["sensors"][0]["at_us"].get<std::int64_t>(), 1'100'000);
}

TEST(SeenCells, AreUnseenBehindWhatHidesThemAndOutsideOfTheView) {
  SeenCells seen;
  seen.add(frame(kNow, std::vector<std::int16_t>(6, 400)));  // a wall at 4 m
  const Cells unseen = cells_of(seen.unseen(Vec3::Zero(), kNow));
  const auto is_unseen = [&](double x, double y) {
    return unseen.contains({static_cast<int>(std::floor(x / 0.25)), static_cast<int>(std::floor(y / 0.25))});
  };
  EXPECT_FALSE(is_unseen(2.1, 0.1));
  EXPECT_FALSE(is_unseen(3.1, -2.1));
  EXPECT_TRUE(is_unseen(4.6, 0.1)) << "behind the wall";
  EXPECT_TRUE(is_unseen(2.1, 3.1)) << "beside the view";
  EXPECT_TRUE(is_unseen(-2.1, 0.1)) << "behind the camera";
}

bool is_in_window(int x, int y, const Vec3& eye, int side) {
  const auto is_near = [side](int k, double middle) {
    const int away = k - static_cast<int>(std::floor(middle / SeenCells::kCell));
    return away >= -side / 2 && away < side / 2;
  };
  return is_near(x, eye.x()) && is_near(y, eye.y());
}

/// The definition: cells in the window that no frame since then has looked through.
/// @param always  a frame counts only for cells that all later windows of its sensor contain as well
Cells unseen_by_definition(const std::vector<SightingSet>& frames, const Vec3& centre, UTime since, bool always) {
  Cells cells;
  for (int x = -100; x <= 200; ++x) {
    for (int y = -100; y <= 100; ++y) {
      if (!is_in_window(x, y, centre, SeenCells::kShown)) continue;
      const auto is_seen_by = [&](const SightingSet& frame) {
        const Vec3& eye = frame.view.sensor_position;
        const Vec3 p(SeenCells::kCell * (x + 0.5), SeenCells::kCell * (y + 0.5), eye.z());
        if (frame.at < since || looked_at(frame.view, p) != Looked::Through) return false;
        return !always || std::ranges::all_of(frames, [&](const SightingSet& later) {
          return later.sensor_id != frame.sensor_id || later.at < frame.at ||
                 is_in_window(x, y, later.view.sensor_position, SeenCells::kSide);
        });
      };
      if (std::ranges::none_of(frames, is_seen_by)) cells.emplace(x, y);
    }
  }
  return cells;
}

TEST(SeenCells, AreSeenOnlyIfAFrameSawThemAndSurelyIfTheyStayInTheWindow) {
  std::mt19937 random(20261129);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  SeenCells seen;
  std::vector<SightingSet> used;
  Vec3 place(-1.0, 2.0, 1.5);
  for (int k = 0; k < 24; ++k) {
    std::vector<std::int16_t> depths(6);
    for (std::int16_t& depth : depths) depth = draw(0, 1) < 0.2 ? kFarDepth : static_cast<std::int16_t>(draw(0, 900));
    SightingSet set = frame(kNow + Duration{k * 100'000}, depths);
    const Eigen::Quaterniond turned =
        Eigen::AngleAxisd(draw(-3, 3), Vec3::UnitZ()) * Eigen::Quaterniond(kAhead[0], kAhead[1], kAhead[2], kAhead[3]);
    set.view.q_WC = {turned.w(), turned.x(), turned.y(), turned.z()};
    set.sensor_id = k % 2;
    place += Vec3(draw(-1, 2), draw(-1, 1), draw(-0.2, 0.2));
    set.view.sensor_position = place;
    seen.add(set);
    used.push_back(set);
    const UTime since = set.at - Duration{1'000'000};
    const Cells unseen = cells_of(seen.unseen(place, since));
    const Cells least = unseen_by_definition(used, place, since, false);
    const Cells most = unseen_by_definition(used, place, since, true);
    EXPECT_TRUE(std::ranges::includes(unseen, least)) << "frame " << k;
    EXPECT_TRUE(std::ranges::includes(most, unseen)) << "frame " << k;
    EXPECT_LT(most.size(), idx(SeenCells::kShown * SeenCells::kShown)) << "something is seen";
  }
}

TEST(SeenCells, BeginAnewWithAnotherFlightAndUseNoFrameTooSoon) {
  SeenCells seen;
  const std::vector<std::int16_t> nothing(6, kBlindDepth), everything(6, kFarDepth);
  const std::size_t all = SeenCells::kShown * SeenCells::kShown;
  const auto unseen = [&] { return cells_of(seen.unseen(Vec3::Zero(), UTime{0})).size(); };
  seen.add(frame(kNow, nothing));
  seen.add(frame(kNow + Duration{100'000}, everything));
  EXPECT_EQ(unseen(), all);
  seen.add(frame(kNow + Duration{200'000}, everything));
  EXPECT_LT(unseen(), all);
  seen.add(frame(kNow, nothing));
  EXPECT_EQ(unseen(), all);
}

}  // namespace
}  // namespace tern
