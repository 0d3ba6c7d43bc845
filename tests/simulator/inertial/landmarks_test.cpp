#include "simulator/inertial/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tern {
namespace {

constexpr double kGrazing = 0.14;

World world_with(const std::vector<ObstacleSpec>& obstacles) {
  Scenario s;
  s.world.obstacles = obstacles;
  return make_world(s, "").value();
}

Region box_region(const std::string& class_name, const Box& box) { return {class_name + "_1", class_name, box}; }

std::map<std::uint64_t, Vec3> places(const std::vector<Landmark>& landmarks) {
  std::map<std::uint64_t, Vec3> all;
  for (const Landmark& landmark : landmarks) all[landmark.id] = landmark.point.p;
  return all;
}

TEST(LandmarkField, IsAPureFunctionOfWorldAndSeed) {
  const World world = world_with({{"", Vec3(10.0, 1.0, 1.0), Vec3::Constant(0.4), StaticMotion{}},
                                  {"", Vec3(6.0, -2.0, 1.0), Vec3::Constant(0.4), StaticMotion{}}});
  const std::vector<Region> regions = {box_region("texture", {Vec3(2, 2, 0), Vec3(8, 6, 3)})};
  LandmarkField here(world, regions, {}, 3), elsewhere_first(world, regions, {}, 3), other(world, regions, {}, 4);
  for (double x = -60.0; x < 60.0; x += 7.0) (void)elsewhere_first.around(Vec3(x, 2.0, 3.0), 25.0, kGrazing, 0.0);
  const Vec3 eye(5.0, 0.0, 1.5);
  const auto a = here.around(eye, 25.0, kGrazing, 0.0), b = elsewhere_first.around(eye, 25.0, kGrazing, 0.0);
  ASSERT_GT(a.size(), 100u);
  EXPECT_EQ(places(a), places(b));
  EXPECT_NE(places(a), places(other.around(eye, 25.0, kGrazing, 0.0)));
  EXPECT_EQ(places(a).size(), a.size()) << "ids are unique";
  EXPECT_TRUE(std::is_sorted(a.begin(), a.end(), [](const auto& x, const auto& y) { return x.id < y.id; }));
}

TEST(LandmarkField, GroundHasTheDensityOfItsRegion) {
  const std::vector<Region> regions = {
      box_region("water", {Vec3(0, 0, 0), Vec3(20, 20, 0.5)}), box_region("texture", {Vec3(20, 0, 0), Vec3(40, 20, 3)}),
      box_region("snow", {Vec3(0, -20, 0), Vec3(20, 0, 1)}), box_region("snow", {Vec3(20, -20, 2), Vec3(40, 0, 5)})};
  LandmarkSpec spec;
  spec.regions.emplace_back("snow", 0.25);
  std::map<std::string, int> found;
  const World empty;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    LandmarkField field(empty, regions, spec, seed);
    for (const Landmark& landmark : field.around(Vec3(20.0, 0.0, 10.0), 60.0, kGrazing, 0.0)) {
      const Vec3& p = landmark.point.p;
      if (landmark.surface != SurfaceClass::Ground || std::abs(p.y()) > 20.0 || p.x() < 0.0 || p.x() > 40.0) continue;
      ++found[p.y() > 0.0 ? (p.x() < 20.0 ? "water" : "texture") : (p.x() < 20.0 ? "snow" : "ground")];
    }
  }
  // A Poisson number of mean m has the standard deviation √m. The region in the air does not cover the ground.
  const auto expect = [&](const char* name, double density) {
    const double mean = density * 400.0 * 20.0;
    EXPECT_NEAR(found[name], mean, 4.0 * std::sqrt(mean)) << name;
  };
  expect("water", 0.03);
  expect("texture", 8.0);
  expect("snow", 0.25);
  expect("ground", 1.0);
}

TEST(LandmarkField, CountsVaryAsAPoissonProcess) {
  const World empty;
  LandmarkField field(empty, {}, {}, 11);
  std::map<std::pair<int, int>, double> count;
  for (const Landmark& landmark : field.around(Vec3(0, 0, 40), 100.0, kGrazing, 0.0)) {
    const Vec3 p = landmark.point.p / 3.0;  // another grid than the field's own
    if (p.head<2>().cwiseAbs().maxCoeff() < 20.0) {
      ++count[{static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))}];
    }
  }
  double mean = 0.0, square = 0.0;
  for (int i = -20; i < 20; ++i) {
    for (int j = -20; j < 20; ++j) {
      const double n = count[{i, j}];
      mean += n / 1600.0;
      square += n * n / 1600.0;
    }
  }
  EXPECT_NEAR(mean, 9.0, 0.3);
  EXPECT_NEAR((square - mean * mean) / mean, 1.0, 0.15);
}

TEST(LandmarkField, ObstaclesCarryTheirLandmarks) {
  const World world =
      world_with({{"", Vec3(4.0, 0.0, 1.0), Vec3(0.5, 0.5, 1.0), StaticMotion{}},
                  {"", Vec3(-4.0, 0.0, 1.0), Vec3(0.5, 0.5, 1.0), LinearMotion{Vec3(0.0, 1.0, 0.0), 0.0}}});
  LandmarkSpec spec;
  spec.ground = 0.0;
  int at_rest = 0, moving = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    LandmarkField field(world, {}, spec, seed);
    const auto now = field.around(Vec3(0, 0, 1), 25.0, kGrazing, 0.0),
               later = field.around(Vec3(0, 0, 1), 25.0, kGrazing, 2.0);
    ASSERT_EQ(now.size(), later.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      const bool moves = now[k].surface == SurfaceClass::Mover;
      (moves ? moving : at_rest) += 1;
      const Vec3 by = later[k].point.p - now[k].point.p;
      EXPECT_LT((by - (moves ? Vec3(0, 2, 0) : Vec3(0, 0, 0))).norm(), 1e-12);
      EXPECT_EQ(now[k].point.v, moves ? Vec3(0, 1, 0) : Vec3(0, 0, 0));
      const Box box = world.obstacles[moves ? 1 : 0].box(0.0);
      EXPECT_NEAR(box.exteriorDistance(now[k].point.p), 0.0, 1e-12);
      EXPECT_GT(box.exteriorDistance(now[k].point.p + 1e-3 * now[k].point.normal), 0.9e-3);
    }
  }
  const double area = 50.0 * (4 * 2.0 + 2 * 1.0);
  EXPECT_NEAR(at_rest, 4.0 * area, 4.0 * std::sqrt(4.0 * area));
  EXPECT_NEAR(moving, 8.0 * area, 4.0 * std::sqrt(8.0 * area));
}

TEST(LandmarkField, OnlyRegionsDenserThanTheGroundHaveSides) {
  const std::vector<Region> regions = {box_region("texture", {Vec3(2, -5, 0), Vec3(3, 5, 4)}),
                                       box_region("water", {Vec3(-5, -5, 0), Vec3(-3, 5, 4)})};
  const World empty;
  int sides = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    LandmarkField field(empty, regions, {}, seed);
    for (const Landmark& landmark : field.around(Vec3(0, 0, 1), 25.0, kGrazing, 0.0)) {
      if (landmark.surface != SurfaceClass::Region) continue;
      ++sides;
      EXPECT_NEAR(regions[0].distance(landmark.point.p), 0.0, 1e-12);
      EXPECT_GT(landmark.point.p.x(), 1.999);
    }
  }
  const double mean = 20.0 * 8.0 * 4.0 * 22.0;
  EXPECT_NEAR(sides, mean, 4.0 * std::sqrt(mean));
}

}  // namespace
}  // namespace tern
