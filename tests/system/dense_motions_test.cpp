// Flights among motions that have too many pieces for a message: they are declared coarser, without a contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "runtime/config.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

/// Only declared motions are known: the vehicle flies into undeclared ones.
std::vector<std::string> through(const std::string& world) {
  return {"world=" + world, "uav.goal=[24, 0, 1]", "uav.flight_box={min: [-2, -5, 0], max: [26, 5, 3]}",
          "simulator.min_flight_s=0", "predictor.model=declared"};
}

/// `people` walk to and fro across the path, recorded at `frames_per_second` for 20 s.
void write_recording(const std::string& file, int people, double frames_per_second) {
  std::ofstream out(file);
  Rng rng(7);
  for (int id = 0; id < people; ++id) {
    const double x = rng.uniform(3.0, 21.0), width = rng.uniform(1.0, 3.5), phase = rng.uniform(0.0, 6.3);
    const double turn_s = width / rng.uniform(1.0, 2.0);
    for (int frame = 0; frame <= static_cast<int>(20.0 * frames_per_second); ++frame) {
      const double t = frame / frames_per_second;
      out << fmt::format("{} {} {:.4f} {:.4f}\n", id, frame, x + 0.2 * std::sin(0.7 * t + phase),
                         width * std::sin(t / turn_s + phase));
    }
  }
}

class RecordedAt : public ::testing::TestWithParam<int> {};

TEST_P(RecordedAt, FramesPerSecondPeopleAreFlownAmongAndNobodyIsTouched) {
  const TempFolder folder;
  write_recording(folder.file("people.txt"), 12, GetParam());
  fly_and_expect_all_well(
      "closing_in", through(fmt::format("{{recorded: [{{file: '{}', columns: 4, frames_per_second: {}, start_s: 3}}]}}",
                                        folder.file("people.txt"), GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Rate, RecordedAt, ::testing::Values(101, 120, 1000));

TEST(DenseMotions, APathOfTenThousandWaypointsIsFlownAroundUntouched) {
  const TempFolder folder;
  std::ofstream out(folder.file("paths.yaml"));
  out << "timeout_s: 20\nworld:\n  obstacles:\n";
  for (int k = 0; k < 3; ++k) {
    out << "    - {motion: waypoints, points: [";
    for (int i = 0; i < 10'000; ++i) {
      const double t = 0.002 * i;
      out << fmt::format("{}[{:.3f}, {:.4f}, {:.4f}, 1]", i == 0 ? "" : ", ", t, 5.0 + 6.0 * k + std::cos(t + k),
                         2.0 * std::sin(0.8 * t + 1.3 * k));
    }
    out << "]}\n";
  }
  out << "uav:\n  goal: [24, 0, 1]\n  flight_box: {min: [-2, -5, 0], max: [26, 5, 3]}\n"
         "predictor:\n  model: declared\n";
  out.close();
  Exchange exchange;
  const VirtualFlight flight = fly_virtually(folder.file("paths.yaml"), {}, &exchange);
  EXPECT_EQ(flight.end, "");
  expect_reached(flight.result);
  expect_answered_once_and_in_time(flight.executor, exchange);
}

class Oscillators : public ::testing::TestWithParam<double> {};

TEST_P(Oscillators, OfAnySlownessAreFlownAroundUntouched) {
  const double s = GetParam();
  fly_and_expect_all_well(
      "closing_in",
      through(fmt::format("{{obstacles: [{{motion: wave, centre: [6, 0, 1], amplitude: [0, 1.5, 0], slowness: {0}}}, "
                          "{{motion: trefoil, centre: [12, 1, 1], scale: 0.4, slowness: {0}}}, "
                          "{{motion: wave, centre: [18, -1, 1], amplitude: [0.5, 1, 0.2], slowness: {0}}}]}}",
                          s)));
}

INSTANTIATE_TEST_SUITE_P(Slowness, Oscillators, ::testing::Values(0.05, 0.02, 0.015, 0.01, 0.001));

void expect_refused(const std::vector<std::string>& overrides, const std::string& words) {
  try {
    (void)fly_virtually(scenario_file("closing_in"), overrides);
    FAIL() << "flown";
  } catch (const ConfigError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(words), std::string::npos) << refusal.what();
  }
}

TEST(DenseMotions, MoreObstaclesThanASetHoldsAreRefusedAtTheStart) {
  expect_refused({"world={generator: paper_corridor, count: 2500}"},
                 "world: 2500 obstacles at once, more than the 1920 that DECLARED_MOTIONS holds");
}

TEST(DenseMotions, AMotionFasterThanAMessageMaySayIsRefusedAtTheStart) {
  expect_refused(
      {"world={obstacles: [{name: light, motion: wave, centre: [9, 9, 9], amplitude: [0, 1e4, 0], "
       "slowness: 0.001}]}"},
      "world: obstacle 0 'light': speed 10000000 m/s, more than the 1000000 m/s that DECLARED_MOTIONS holds");
}

}  // namespace
}  // namespace tern::testing
