// Flights among recorded people and around a scanned house.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

class RecordedWorlds : public ::testing::Test {
 protected:
  RecordedWorlds() { setenv("TERN_DATA", TERN_DATA_FOLDER, 1); }
};

class Crowd : public RecordedWorlds, public ::testing::WithParamInterface<int> {};

/// The seed draws time, direction and lane.
TEST_P(Crowd, IsCrossedAndNobodyIsTouched) { fly_and_expect_all_well("crowd", {"seed=" + std::to_string(GetParam())}); }

INSTANTIATE_TEST_SUITE_P(Flight, Crowd, ::testing::Range(1, 6));

TEST_F(RecordedWorlds, PeopleBeforeABuildingAreCrossed) { fly_and_expect_all_well("crowd_eth"); }

TEST_F(RecordedWorlds, TheTownIsFlownThroughAroundItsHouse) { fly_and_expect_all_well("lidar_town"); }

}  // namespace
}  // namespace tern::testing
