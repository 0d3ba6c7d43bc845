// Bounds of a flight's measures, from states that were measured and not commanded.
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tools/audit/flight_record.h"
#include "tools/audit/measures.h"

namespace tern::audit {
namespace {

constexpr int kStates = 4'000;  // 40 s

/// A vehicle with an autopilot: it flies at `speed` along x for 40 s. Its positions have errors of some centimetres
/// that drift, and are rounded to 1 cm, as geographic coordinates are.
FlightRecord measured_flight(double speed, std::uint64_t seed) {
  Rng rng(seed);
  FlightRecord record;
  Vec3 error = Vec3::Zero();
  for (int k = 0; k < kStates; ++k) {
    const Vec3 noise(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
    error = 0.97 * error + 0.012 * noise;
    UavState state;
    state.header.name.sender_epoch_us = 1;
    state.at = UTime{1'000'000 + 10'000LL * k};
    state.motion.p = (100.0 * (Vec3(0.01 * speed * k, 0.0, 5.0) + error)).array().round() / 100.0;
    state.motion.v = Vec3(speed, 0.0, 0.0);
    record.states.push_back(state);
  }
  FlightResult result;
  result.header.name.sender_epoch_us = 2;  // the referee is another process
  result.header.utime = record.states.back().at;
  record.results.push_back(result);
  return record;
}

TEST(AuditMeasures, TheWayOfASlowMeasuredVehicleIsNoLongerThanItWas) {
  for (const double speed : {0.02, 0.4, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const double flown = speed * 0.01 * (kStates - 1);
      const Between path = measure(measured_flight(speed, seed)).path_m;
      EXPECT_LE(path.low, flown) << speed << " m/s, seed " << seed;
      EXPECT_GE(path.low, 0.95 * flown - 1.2) << speed << " m/s, seed " << seed;
      EXPECT_GE(path.high, flown);
    }
  }
}

}  // namespace
}  // namespace tern::audit
