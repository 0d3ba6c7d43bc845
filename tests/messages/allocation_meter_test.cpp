#include "tests/messages/allocation_meter.h"

#include <gtest/gtest.h>

#include <vector>

namespace tern {
namespace {

TEST(AllocationMeter, SeesTheLargestAndTheMostHeldAtOnce) {
  const AllocationMeter meter;
  { const std::vector<char> released(5'000'000); }
  const std::vector<char> kept(3'000'000);
  EXPECT_EQ(meter.largest(), 5'000'000U);
  EXPECT_GE(meter.peak(), 5'000'000U);
  EXPECT_LT(meter.peak(), 6'000'000U);
}

}  // namespace
}  // namespace tern
