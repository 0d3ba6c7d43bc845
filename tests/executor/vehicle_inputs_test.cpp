#include "executor/vehicle_inputs.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

constexpr UTime kStart{1'000'000'000};
UTime after(double s) { return kStart + Duration::from_seconds(s); }
using Trouble = std::pair<std::string, std::string>;

TEST(VehicleInputs, AreNotUsableBeforeBothHaveCome) {
  VehicleInputs inputs;
  EXPECT_FALSE(inputs.usable(kStart));
  EXPECT_EQ(inputs.trouble(kStart), Trouble("UAV_STATE", "silent so far"));
  inputs.add_state(kStart, kStart);
  EXPECT_EQ(inputs.trouble(kStart), Trouble("VEHICLE_STATUS", "silent so far"));
  inputs.add_status(kStart, kStart);
  EXPECT_TRUE(inputs.usable(kStart));
  EXPECT_FALSE(inputs.trouble(kStart));
}

TEST(VehicleInputs, AreUsableUpToTheirLargestAge) {
  VehicleInputs inputs;
  inputs.add_state(kStart, kStart);
  inputs.add_status(after(0.1), after(0.1));
  EXPECT_EQ(inputs.usable_until(), kStart + VehicleInputs::kMaxAge);
  EXPECT_TRUE(inputs.usable(inputs.usable_until()));
  EXPECT_FALSE(inputs.usable(inputs.usable_until() + Duration{1}));
  EXPECT_EQ(inputs.trouble(after(0.4)), Trouble("UAV_STATE", "silent for 0.4 s"));
  inputs.add_state(after(0.4), after(0.4));
  EXPECT_EQ(inputs.trouble(after(0.6)), Trouble("VEHICLE_STATUS", "silent for 0.5 s"));
}

TEST(VehicleInputs, AStateThatArrivesInTimeButIsOldIsNotUsable) {
  VehicleInputs inputs;
  inputs.add_state(kStart, after(2.0));
  inputs.add_status(after(2.0), after(2.0));
  EXPECT_EQ(inputs.trouble(after(2.0)), Trouble("UAV_STATE", "2.0 s old"));
}

TEST(VehicleInputs, AMessageThatWasOvertakenMakesNothingOlder) {
  VehicleInputs inputs;
  inputs.add_status(after(0.2), after(0.2));
  inputs.add_state(after(0.2), after(0.2));
  inputs.add_state(after(0.1), after(0.21));
  EXPECT_EQ(inputs.usable_until(), after(0.2) + VehicleInputs::kMaxAge);
}

}  // namespace
}  // namespace tern
