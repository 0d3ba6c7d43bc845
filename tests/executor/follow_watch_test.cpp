#include "executor/follow_watch.h"

#include <gtest/gtest.h>

#include <array>

#include "core/base/random.h"

namespace tern {
namespace {

/// States 10 ms apart, each `off` m beside the committed trajectory along x, in a tube of 0.2 m.
class Watched {
 public:
  FollowWatch::Judgement judge(double off) {
    state.measured.p.x() = off;
    at_ = at_ + Duration{10'000};
    return watch.judge(state, at_);
  }
  Following last_of(const std::vector<double>& offs) {
    Following last = Following::Unsure;
    for (const double off : offs) last = judge(off).answer;
    return last;
  }
  FollowWatch watch;
  TrackedState state{.measured = {}, .committed = {}, .tube = Vec3::Constant(0.2), .follows = true};

 private:
  UTime at_{1'000'000};
};

TEST(FollowWatch, EachRowOfItsTable) {
  EXPECT_EQ(Watched().last_of({0, 0, 0, 5}), Following::Unsure) << "one state alone is no reason";
  EXPECT_EQ(Watched().last_of({0.05, 0.05, 0.05}), Following::Inside);
  EXPECT_EQ(Watched().last_of({0.25, 0.25, 0.25}), Following::Outside);
  EXPECT_EQ(Watched().last_of({0.4, 0.4, 0.4}), Following::Lost);
  Watched held;
  held.state.follows = false;
  EXPECT_EQ(held.last_of({0.05, 0.05, 0.05}), Following::Held);
  EXPECT_EQ(held.last_of({0.15, 0.15, 0.15}), Following::Carried) << "outside kRejoinBeyond, inside the tube";
  held.state.reports_following = true;
  EXPECT_EQ(held.last_of({0.15, 0.15, 0.15}), Following::OldMessages);
  Watched silent;
  silent.state.after_silence = true;
  EXPECT_EQ(silent.last_of({0.3, 0.3, 0.3}), Following::Departed);
  EXPECT_EQ(Watched(silent).last_of({0.1}), Following::Inside);
}

TEST(FollowWatch, AfterASilenceAVehicleWithoutTubeMustHaveTheSameMotion) {
  Watched silent;
  silent.state.after_silence = true;
  silent.state.tube.setZero();
  EXPECT_EQ(silent.judge(0.0).answer, Following::Inside);
  silent.state.measured.v.y() = 0.1;
  EXPECT_EQ(silent.judge(0.0).answer, Following::Departed);
  silent.state.measured.v.setZero();
  silent.state.measured.a.z() = 0.1;
  EXPECT_EQ(silent.judge(0.0).answer, Following::Departed);
  silent.state.after_silence = false;
  EXPECT_EQ(silent.judge(0.0).answer, Following::Inside) << "at other times the controller may correct";
}

TEST(FollowWatch, CountsAnExitOnceUntilTheVehicleIsBack) {
  Watched vehicle;
  vehicle.judge(0.0);
  EXPECT_FALSE(vehicle.judge(0.25).leaves) << "the state before was inside";
  EXPECT_FALSE(vehicle.judge(0.25).leaves) << "unsure: not yet in all newest states";
  EXPECT_TRUE(vehicle.judge(0.25).leaves);
  EXPECT_FALSE(vehicle.judge(0.25).leaves);
  EXPECT_EQ(vehicle.watch.exits(), 1);
  vehicle.last_of({0, 0, 0, 0.25, 0.25, 0.25, 0.25});
  EXPECT_EQ(vehicle.watch.exits(), 2);
}

/// A rejoin moves the commanded position. So no two forged states may cause one.
TEST(FollowWatch, TwoForgedStatesAmongTrueOnesNeverCauseARejoin) {
  Rng rng(7);
  for (int round = 0; round < 2000; ++round) {
    Watched vehicle;
    vehicle.state.follows = rng.uniform() < 0.5;
    vehicle.last_of({0, 0, 0});
    for (int k = 0; k < 12; ++k) {
      const bool forged = k % 3 != 0;
      const auto answer = vehicle.judge(forged ? rng.uniform(-50.0, 50.0) : rng.uniform(-0.05, 0.05)).answer;
      EXPECT_NE(answer, Following::Lost);
      EXPECT_NE(answer, Following::Carried);
    }
  }
}

}  // namespace
}  // namespace tern
