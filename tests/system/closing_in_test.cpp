// A vehicle at rest at its goal, and a box that flies through where it rests.
#include <fmt/format.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tern::testing
