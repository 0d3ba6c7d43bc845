#include "simulator/vehicle/perfect_vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tern {
namespace {

constexpr UTime kStart{1'700'000'000'000'000};

// A busy machine held up the executor, then the thread that receives its setpoints. At 0.34 s no setpoint after 0.15 s
// has arrived, and the late ones belong to a trajectory that was committed after 0.15 s.
TEST(PerfectVehicle, FollowsSetpointsThatComeLateAfterAll) {
  const auto path = [](double t) {
    MotionSample m;
    if (t < 0.01) return m;
    m.j = Vec3(t < 0.2 ? 20.0 : -30.0, 0.0, 0.0);
    const double u = std::min(t, 0.2) - 0.01, w = std::max(t, 0.2) - 0.2;
    m.a.x() = 20.0 * u - 30.0 * w;
    m.v.x() = 10.0 * u * u + 20.0 * u * w - 15.0 * w * w;
    m.p.x() = 20.0 / 6.0 * u * u * u + 10.0 * u * u * w + 10.0 * u * w * w - 5.0 * w * w * w;
    return m;
  };
  UavSpec uav;
  uav.start = Vec3::Zero();
  PerfectVehicle vehicle(uav, kStart);
  const auto receive = [&](int from_cs, int to_cs) {
    for (int cs = from_cs; cs <= to_cs; ++cs) {
      UavState setpoint;
      setpoint.at = kStart + Duration{10'000 * cs};
      setpoint.motion = path(0.01 * cs);
      vehicle.receive(setpoint);
    }
  };
  receive(1, 15);
  vehicle.advance(kStart + Duration{340'000});
  receive(16, 34);
  vehicle.advance(kStart + Duration{350'000});
  for (double t = 0.0; t < 0.34; t += 0.003) {
    const MotionSample flown = vehicle.truth().sample(kStart + Duration::from_seconds(t));
    EXPECT_LT((flown.p - path(t).p).norm(), 1e-9) << t;
  }
}

}  // namespace
}  // namespace tern
