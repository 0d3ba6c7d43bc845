#include "simulator/referee/believed_arrival.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tern {
namespace {

const Vec3 kGoal(75, -1, 1);

UTime at_s(double t) { return UTime{} + Duration::from_seconds(t); }
MotionSample motion(const Vec3& from_goal, const Vec3& v = Vec3::Zero()) {
  MotionSample sample;
  sample.p = kGoal + from_goal;
  sample.v = v;
  return sample;
}
const MotionSample kThere = motion(Vec3::Zero());

double nothing(double /*t*/) { return 0.0; }
/// When a vehicle has arrived within 20 s; setpoint, belief and the correction to come are functions of the time, s.
std::optional<double> arrives(auto setpoint, auto believed, double (*to_come)(double) = nothing) {
  BelievedArrival arrival;
  for (double t = 0.0; t < 20.0; t += 0.01) {
    if (arrival.update(at_s(t), kGoal, setpoint(t), believed(t), to_come(t))) return t;
  }
  return std::nullopt;
}
MotionSample there(double /*t*/) { return kThere; }

TEST(BelievedArrival, ComesTwoSecondsAfterTheVehicleBelievesToRestAtItsGoal) {
  const auto late = [](double t) { return t < 1.0 ? motion(Vec3(0.3, 0, 0)) : kThere; };
  EXPECT_NEAR(arrives(there, late).value_or(0.0), 3.0, 0.011);
}

TEST(BelievedArrival, ComesAlthoughCorrectionsShakeTheBelievedVelocity) {
  const auto shaken = [](double t) { return motion(Vec3(0.1, 0, 0), Vec3(std::fmod(t, 1.0) < 0.5 ? 0.3 : 0.0, 0, 0)); };
  EXPECT_NEAR(arrives(there, shaken).value_or(0.0), 2.5, 0.02);
}

TEST(BelievedArrival, WaitsUntilTheVehicleIsBackFromACorrectionOfItsPosition) {
  const auto corrected = [](double t) { return motion(Vec3(t > 1.5 && t < 4.0 ? 0.5 : 0.0, 0, 0)); };
  EXPECT_NEAR(arrives(there, corrected).value_or(0.0), 4.0, 0.02);
}

TEST(BelievedArrival, WaitsForALargeCorrectionAndNotForSmallOnes) {
  const auto tag_seen = [](double t) { return std::max(0.0, 0.4 - 0.1 * t); };  // followed after 3.5 s to 5 cm
  EXPECT_NEAR(arrives(there, there, tag_seen).value_or(0.0), 5.5, 0.021);
  const auto small = [](double t) { return 0.04 * std::fmod(t, 1.0); };
  EXPECT_NEAR(arrives(there, there, small).value_or(0.0), 2.0, 0.011);
  const auto without_end = [](double t) { return std::fmod(t, 1.0); };
  EXPECT_NEAR(arrives(there, there, without_end).value_or(0.0), 10.0, 0.011);
}

TEST(BelievedArrival, DoesNotComeElsewhere) {
  const auto beside = [](double) { return motion(Vec3(0.25, 0, 0)); };
  const auto passing = [](double) { return motion(Vec3::Zero(), Vec3(0.2, 0, 0)); };
  EXPECT_FALSE(arrives(beside, beside)) << "it stands beside the goal";
  EXPECT_FALSE(arrives(there, beside)) << "it believes to be beside the goal";
  EXPECT_FALSE(arrives(beside, there)) << "it was told to be elsewhere, and will go there";
  EXPECT_FALSE(arrives(passing, there));
  EXPECT_FALSE(arrives(there, passing)) << "it has never believed to rest";
}

TEST(BelievedArrival, WaitsAnewForANewGoal) {
  BelievedArrival arrival;
  EXPECT_FALSE(arrival.update(at_s(0.0), kGoal, kThere, kThere, 0.0));
  const Vec3 next = kGoal + Vec3(5, 0, 0);
  EXPECT_FALSE(arrival.update(at_s(1.0), next, kThere, kThere, 0.0));
  EXPECT_FALSE(arrival.update(at_s(2.5), kGoal, kThere, kThere, 0.0));
  arrival.reset();
  EXPECT_FALSE(arrival.update(at_s(4.6), kGoal, kThere, kThere, 0.0));
  EXPECT_TRUE(arrival.update(at_s(6.6), kGoal, kThere, kThere, 0.0));
}

}  // namespace
}  // namespace tern
