// Missions and fences from files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mission/readers/mission_file.h"
#include "semantic_mapper/sources/fence_file.h"
#include "tests/mission/some_site.h"

namespace tern::mission {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::some_site;

std::vector<std::string> names(const Mission& mission) {
  std::vector<std::string> names;
  for (const Step& step : mission.steps) names.push_back(step.name);
  return names;
}

std::string refusal(std::string_view text, const std::string& file) {
  const auto mission = parse_mission(text, file, some_site());
  return mission ? "" : mission.error().message;
}

TEST(MissionFile, APlanOfQGroundControlIsRead) {
  const Mission mission = parse_mission(testing::kPlan, "a.plan", some_site()).value();
  EXPECT_THAT(names(mission),
              ElementsAre("take-off 1", "waypoint 2", "waypoint 3", "waypoint 4", "above return 5", "return 5"));
  EXPECT_EQ(mission.steps[2].action, Action::Stop);
  EXPECT_EQ(mission.steps[2].hold_s, 4.0);
  EXPECT_EQ(mission.steps[3].radius, 3.0);
  const LocalFrame frame = *some_site().frame;
  EXPECT_LT((mission.steps[1].position - frame.to_world({47.3979, 8.5456, 498.0})).norm(), 1e-9);
  EXPECT_LT((mission.steps[3].position - frame.to_world({47.3977, 8.5459, 500.0})).norm(), 1e-9);
}

TEST(MissionFile, CsvIsRead) {
  const Mission mission = parse_mission(testing::kCsv, "a.csv", some_site()).value();
  EXPECT_THAT(names(mission), ElementsAre("gate", "look", "waypoint 3", "above landing 4", "landing 4"));
  EXPECT_EQ(mission.steps[0].radius, 3.0);
  EXPECT_EQ(mission.steps[1].hold_s, 4.0);
  EXPECT_EQ(mission.steps[2].action, Action::Follow);
  EXPECT_EQ(mission.steps[2].track, 7);
  EXPECT_EQ(mission.steps[4].position, Vec3(0, 0, 1));
}

TEST(MissionFile, CsvOfTheEarthIsRead) {
  const Mission mission = parse_mission("latitude,longitude,height\n47.3979,8.5456,10\n", "a.csv", some_site()).value();
  EXPECT_LT((mission.steps[0].position - some_site().frame->to_world({47.3979, 8.5456, 498.0})).norm(), 1e-9);
}

TEST(MissionFile, GeoJsonIsRead) {
  const Mission mission = parse_mission(testing::kGeoJson, "a.geojson", some_site()).value();
  EXPECT_THAT(names(mission), ElementsAre("gate", "waypoint 2", "waypoint 3"));
  EXPECT_LT((mission.steps[2].position - some_site().frame->to_world({47.3979, 8.5459, 500.0})).norm(), 1e-9);
}

TEST(MissionFile, RefusalsNameFileLineAndValue) {
  EXPECT_EQ(refusal("x,y,z\n1,2\n", "a.csv"), "a.csv: line 2: has 2 cells, not 3");
  EXPECT_EQ(refusal("x,y,z\n1,nan,3\n", "a.csv"), "a.csv: line 2: y \"nan\" is no finite number");
  EXPECT_EQ(refusal("x,y\n", "a.csv"),
            "a.csv: line 1: column z is missing: give x, y, z, or latitude, longitude, height");
  EXPECT_THAT(refusal("x,y,z,colour\n", "a.csv"), HasSubstr("line 1: column \"colour\" is unknown"));
  EXPECT_EQ(refusal("x,y,z,action\n1,2,3,dance\n", "a.csv"),
            "a.csv: line 2: action dance is not pass, stop, land, return or follow");
  EXPECT_EQ(refusal("x,y,z,action,hold_s\n1,2,3,pass,4\n", "a.csv"),
            "a.csv: line 2: action pass: hold_s has no meaning");
  EXPECT_EQ(refusal("", "a.csv"), "a.csv: has no line that names columns");
  EXPECT_EQ(refusal("x,y,z\n", "a.csv"), "a.csv: has no waypoint");
  EXPECT_EQ(refusal("{", "a.plan"), "a.plan: is no JSON, or ends too early");
  EXPECT_EQ(refusal("{\"fileType\": \"Plan\", \"version\": 2}", "a.plan"),
            "a.plan: version is not 1, the only one that is known");
  EXPECT_THAT(refusal(R"({"fileType": "Plan", "version": 1, "mission": {"items": [
                          {"type": "ComplexItem", "complexItemType": "survey"}]}})",
                      "a.plan"),
              HasSubstr("mission.items[0]: type \"ComplexItem\" (survey) cannot be flown"));
  EXPECT_EQ(refusal("", "a.kml"), "a.kml: its name must end in .plan, .csv, .geojson or .json");
  EXPECT_EQ(refusal(std::string(100'000, '['), "a.plan"), "a.plan: is nested more deeply than 32 levels");
}

TEST(MissionFile, ASpeedIsReadAndOneOfAnotherNameRefused) {
  const auto geojson = [](const std::string& property) {
    return R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {)" + property +
           R"(}, "geometry": {"type": "Point", "coordinates": [8.5457, 47.3978, 10]}}]})";
  };
  const auto speeds_of = [](const std::string& text, const std::string& file) {
    std::vector<double> speeds;
    const Mission mission = parse_mission(text, file, testing::some_site()).value();
    for (const Step& step : mission.steps) speeds.push_back(step.speed);
    return speeds;
  };
  EXPECT_EQ(speeds_of("x,y,z,speed\n1,2,3,4\n5,6,7,\n", "a.csv"), (std::vector<double>{4.0, 0.0}));
  EXPECT_EQ(speeds_of(geojson(R"("speed": 3)"), "a.geojson"), std::vector<double>{3.0});
  EXPECT_EQ(refusal("x,y,z,speed\n1,2,3,0\n", "a.csv"), "a.csv: line 2: a speed of 0 m/s cannot be flown");
  EXPECT_EQ(refusal("x,y,z,speed\n1,2,3,1e3\n", "a.csv"),
            "a.csv: line 2: a speed of 1000 m/s is out of range [0.1, 100]");
  EXPECT_EQ(refusal("x,y,z,Speed_mps\n1,2,3,4\n", "a.csv"),
            std::string("a.csv: line 1: column \"Speed_mps\" ") + kOtherSpeed);
  EXPECT_EQ(refusal(geojson(R"("max_velocity": 3)"), "a.geojson"),
            std::string("a.geojson: features[0]: property max_velocity ") + kOtherSpeed);
  EXPECT_EQ(refusal(geojson(R"("colour": "red", "maxSpeed": null)"), "a.geojson"), "");
}

TEST(MissionFile, RallyPointsAreRefusedByName) {
  std::string plan = testing::kPlan;
  const std::string none = "\"points\": []";
  plan.replace(plan.find(none), none.size(), "\"points\": [[47.3978, 8.5457, 10]]");
  EXPECT_THAT(refusal(plan, "a.plan"), HasSubstr("has 1 rally points, which cannot be flown to"));
}

TEST(MissionFile, ABreachReturnPointIsRefusedByName) {
  std::string plan = testing::kPlan;
  const std::string circles = "\"circles\":";
  ASSERT_NE(plan.find(circles), std::string::npos);
  plan.replace(plan.find(circles), circles.size(), "\"breachReturn\": [47.3978, 8.5457, 10], " + circles);
  EXPECT_THAT(refusal(plan, "a.plan"), HasSubstr("has a breach return point, which cannot be flown to"));
}

TEST(FenceFile, FencesOfAPlanAreRead) {
  const auto fences = parse_fences(testing::kPlan, "a.plan").value();
  ASSERT_EQ(fences.size(), 2u);
  EXPECT_TRUE(fences[0].is_inclusion);
  EXPECT_FALSE(fences[1].is_inclusion);
  EXPECT_EQ(std::get<FenceCircle>(fences[1].shape).radius, 5.0);
  const Fence in_world = to_world(fences[0], *some_site().frame).value();
  const Vec3 corner = some_site().frame->to_world({47.3972, 8.5450, 488.0});
  EXPECT_LT((std::get<FencePolygon>(in_world.shape).corners[0] - corner.head<2>()).norm(), 1e-9);
}

TEST(FenceFile, FencesOfGeoJsonAreRead) {
  const auto fences = parse_fences(testing::kGeoJson, "a.geojson").value();
  ASSERT_EQ(fences.size(), 2u);
  EXPECT_EQ(fences[0].ceiling, 30.0);
  EXPECT_EQ(std::get<FencePolygon>(fences[0].shape).corners.size(), 4u);
  EXPECT_EQ(fences[1].name, "mast");
}

TEST(FenceFile, RefusalsNameFileFenceAndValue) {
  const auto refused = [](const std::string& fence) {
    const auto read = parse_fences("{\"fileType\": \"Plan\", \"geoFence\": {\"polygons\": [" + fence + "]}}", "a.plan");
    return read ? "" : read.error().message;
  };
  EXPECT_EQ(refused("{}"), "a.plan: geoFence.polygons[0]: inclusion is neither true nor false");
  EXPECT_EQ(refused(R"({"inclusion": true, "polygon": [[1, 2]]})"),
            "a.plan: geoFence.polygons[0]: 1 corners (limit 3 to 1000)");
  EXPECT_EQ(refused(R"({"inclusion": true, "polygon": [[1, 2], [3, 4], [95, 6]]})"),
            "a.plan: geoFence.polygons[0]: latitude 95 is out of range [-90, 90]");
}

}  // namespace
}  // namespace tern::mission
