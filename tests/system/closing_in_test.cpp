// A vehicle at rest at its goal, and a box that flies through its place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

struct Intruder {
  const char* name;
  Vec3 direction;     ///< of its flight
  double distance_m;  ///< from the vehicle at the start, centre to centre
  double speed_mps;
};

class ClosingIn : public ::testing::TestWithParam<Intruder> {};

TEST_P(ClosingIn, IsEvadedAndTheVehicleComesBack) {
  const Intruder& intruder = GetParam();
  const Vec3 goal(0, 0, 1);
  const Vec3 d = intruder.direction.normalized();
  const Vec3 from = goal - intruder.distance_m * d;
  const Vec3 v = intruder.speed_mps * d;
  const double gone_s = (intruder.distance_m + 5.0) / intruder.speed_mps;
  const VirtualFlight flight = fly_and_expect_all_well(
      "closing_in", {fmt::format("world.obstacles[0].centre=[{}, {}, {}]", from.x(), from.y(), from.z()),
                     fmt::format("world.obstacles[0].velocity=[{}, {}, {}]", v.x(), v.y(), v.z()),
                     fmt::format("simulator.min_flight_s={}", gone_s)});
  EXPECT_GE(flight.result.flight_time_s, gone_s - 0.01);
  EXPECT_GT(flight.result.path_length_m, 2.0 * 0.4) << "the intruder is 0.5 m wide on each side: there and back";
}

INSTANTIATE_TEST_SUITE_P(From, ClosingIn,
                         ::testing::Values(Intruder{"TheSide", {0, -1, 0}, 12, 3},
                                           Intruder{"TheSideFast", {0, -1, 0}, 12, 5},
                                           Intruder{"Behind", {1, 0, 0}, 8, 2}, Intruder{"Above", {0, 0, -1}, 8, 3},
                                           Intruder{"ACorner", {-1, -1, 0}, 10, 3},
                                           Intruder{"AskewBelow", {-1.5, 2, 0.5}, 9, 2.5}),
                         [](const auto& flight) { return flight.param.name; });

/// Faces and corners of a cube.
std::vector<Vec3> fourteen_directions() {
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int axes = std::abs(x) + std::abs(y) + std::abs(z);
        if (axes == 1 || axes == 3) directions.push_back(Vec3(x, y, z).normalized());
      }
    }
  }
  return directions;
}

class AppearsASecondBefore : public ::testing::TestWithParam<Vec3> {};

TEST_P(AppearsASecondBefore, AndIsEvadedAtTheVehiclesTopSpeed) {
  constexpr double kSpeed = 6.0;  // m/s: v_max of the vehicle
  constexpr double kSeen = 1.0;   ///< s of flight to the vehicle when the box appears, centre to centre
  const Vec3 goal(0, 0, 10);
  const Vec3 from = goal - kSeen * kSpeed * GetParam();
  const Vec3 to = goal + 2.0 * kSeen * kSpeed * GetParam();
  const VirtualFlight flight = fly_and_expect_all_well(
      "closing_in",
      {fmt::format("world.obstacles=[{{name: intruder, half_extents: 0.4, motion: waypoints, vanish: true, "
                   "points: [[1, {}, {}, {}], [4, {}, {}, {}]]}}]",
                   from.x(), from.y(), from.z(), to.x(), to.y(), to.z()),
       "uav.start=[0, 0, 10]", "uav.goal=[0, 0, 10]", "uav.flight_box={min: [-30, -30, -20], max: [30, 30, 40]}",
       "simulator.min_flight_s=4"});
  EXPECT_GT(flight.result.path_length_m, 2.0 * 0.4) << "the box is 0.4 m wide on each side: there and back";
}

INSTANTIATE_TEST_SUITE_P(From, AppearsASecondBefore, ::testing::ValuesIn(fourteen_directions()));

}  // namespace
}  // namespace tern::testing
