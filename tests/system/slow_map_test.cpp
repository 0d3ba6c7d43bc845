// A map that takes longer on the bus than the simulator waits for processes: the wait grows with it.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/random.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

TEST(SlowMap, IsWaitedForLongerThanTheWait) {
  const TempFolder folder;
  constexpr int kLeaves = 250'000;
  std::ofstream wood(folder.file("wood.ply"));
  wood << "ply\nformat ascii 1.0\nelement vertex " << kLeaves
       << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  Rng rng(4);
  for (int k = 0; k < kLeaves; ++k) {
    wood << rng.uniform(0.0, 40.0) << ' ' << rng.uniform(0.0, 40.0) << ' ' << rng.uniform(8.0, 24.0) << '\n';
  }
  wood.close();
  std::ofstream(folder.file("wood.yaml"))
      << "mapper: {extents: {min: [0, 0, -1], max: [40, 40, 25]}, sources: [{file: wood.ply}]}\n"
         "simulator: {wait_s: 1}\n"
         "uav: {start: [5, 5, 2], goal: [12, 12, 2], flight_box: {min: [0, 0, 0], max: [40, 40, 8]}}\n";
  expect_reached(fly_virtually(folder.file("wood.yaml"), {}).result);
}

}  // namespace
}  // namespace tern::testing
