#include "planner/app/unseen_intake.h"

#include <gtest/gtest.h>

#include "tests/planner/app/answers.h"
#include "tests/support/corridor_frames.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kNow{50'000'000};
const Vec3 kHome(0, 0, 1);

/// A lidar at home that sees nothing yet, and requests of executors by their epochs.
class UnseenIntakeTest : public ::testing::Test {
 protected:
  void see() {
    SightingSet frame = frame_at(clock_.now(), 0, Vec2(0, 0), [](double) { return 10.0; });
    for (std::int16_t& depth : frame.view.depths) depth = kBlindDepth;
    answers_.bus().publish(channels::kObstacleSightings, frame);
    answers_.hear();
  }
  void ask(std::int64_t epoch_us, const Vec3& p, const Vec3& way = Vec3::Zero()) {
    HorizonRequest request = request_at(clock_.now() + Duration{75'000}, resting_at(p, kNow));
    request.header.name.sender_epoch_us = epoch_us;
    request.committed.control_points.rightCols(3).colwise() += way;
    request.start.p = p;
    intake_.set_vehicle(request);
  }
  [[nodiscard]] double clear_at_home() const { return intake_.snapshot()->field->distance(Vec2(0, 0)); }

  SharedClock clock_{kNow};
  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  Bus bus_{lcm_, clock_, 7};
  Answers answers_{lcm_, clock_};
  UnseenIntake intake_{bus_, UnseenMovers{}, kHome};
};

TEST_F(UnseenIntakeTest, TakeOffIsClear) {
  see();
  ask(1, kHome + Vec3(0.2, 0, 0.1), Vec3(0.03, 0, 0));  // a hover
  EXPECT_GT(clear_at_home(), 1.5);
  ask(1, kHome + Vec3(0.5, 0, 0), Vec3(3, 0, 0));
  EXPECT_GT(clear_at_home(), 1.5) << "the vehicle departs, and knows what it knew";
}

TEST_F(UnseenIntakeTest, APlannerThatIsStartedInFlightNearTheStartKnowsNothing) {
  see();
  ask(1, kHome + Vec3(0.5, 0, 0), Vec3(3, 0, 0));
  see();
  EXPECT_EQ(clear_at_home(), 0.0);
}

TEST_F(UnseenIntakeTest, AVehicleThatHoversHighAboveItsStartKnowsNothing) {
  see();
  ask(1, kHome + Vec3(0, 0, 5));
  see();
  EXPECT_EQ(clear_at_home(), 0.0);
}

TEST_F(UnseenIntakeTest, AnExecutorThatIsRestartedInFlightNearTheStartKnowsNothing) {
  see();
  ask(1, kHome);
  ask(2, kHome + Vec3(0.5, 0, 0), Vec3(3, 0, 0));
  see();
  EXPECT_EQ(clear_at_home(), 0.0);
  ask(3, kHome);
  see();
  EXPECT_GT(clear_at_home(), 1.5) << "the next flight takes off";
}

TEST_F(UnseenIntakeTest, AFirstPictureAfterDepartureFindsNothingClear) {
  ask(1, kHome);
  ask(1, kHome + Vec3(0.5, 0, 0), Vec3(3, 0, 0));
  see();
  EXPECT_EQ(clear_at_home(), 0.0);
}

}  // namespace
}  // namespace tern
