// The planner's field of unseen movers against the auditor's, which shares no code with it.
#include <gtest/gtest.h>

#include "planner/unseen/unseen_watch.h"
#include "tests/support/corridor_frames.h"
#include "tools/audit/unseen_space.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};

/// The auditor rounds directions to a quarter of a degree, so single cells at the edges of sight may differ.
TEST(AuditedField, AgreesWithThePlannersAlongAFlightByTwoSensors) {
  double sum = 0.0, largest = 0.0;
  int points = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Rng rng(seed);
    const Corridor corridor(rng);
    UnseenMovers movers;
    movers.max_speed_mps = rng.uniform(0.5, 2.5);
    UnseenWatch watch(movers, Vec3::Zero());
    audit::UnseenSpace space({movers.max_speed_mps, movers.least_width_m, movers.clear_radius_m}, Vec2::Zero());
    Vec2 p(0, 0);
    for (int tick = 0; tick < 40; ++tick, p.x() += 0.15) {
      const UTime at = kZero + Duration{tick * 50'000 - (tick % 2 == 1 ? 120'000 : 0)};
      const SightingSet frame = frame_at(at, tick % 2, p, [&](double azimuth) { return corridor.range(p, azimuth); });
      watch.add(frame);
      space.add(frame);
      ASSERT_EQ(watch.knowledge().pictures, space.frames());
      ASSERT_EQ(watch.knowledge().at, space.at());
      for (int k = 0; k < 50; ++k) {
        const Vec2 probe = p + Vec2(rng.uniform(-4, 4), rng.uniform(-3, 3));
        const double apart = std::abs(watch.knowledge().field->distance(probe) - space.distance(probe));
        largest = std::max(largest, apart);
        sum += apart;
        ++points;
      }
    }
  }
  EXPECT_LT(sum / points, 0.02);
  EXPECT_LT(largest, 0.6);
}

}  // namespace
}  // namespace tern
