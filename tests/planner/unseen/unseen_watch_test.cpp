#include "planner/unseen/unseen_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/corridor_frames.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kZero{1'700'000'000'000'000};

SightingSet open_frame(UTime at, std::int32_t sensor, const Vec2& p, std::int64_t sequence = 1) {
  SightingSet frame = frame_at(at, sensor, p, [](double) { return 10.0; });
  frame.header.name = {7, sequence};
  return frame;
}

constexpr Duration kTick{100'000};

TEST(UnseenWatch, KnowsNothingBeforeItsFirstPictureAndTheClearBallOnlyAtTakeOff) {
  UnseenMovers movers;
  movers.clear_radius_m = 2.0;
  UnseenWatch at_start(movers, Vec3(1, 0, 0)), elsewhere(movers, Vec3(20, 0, 0));
  EXPECT_FALSE(at_start.knowledge().field);
  SightingSet blind = open_frame(kZero, 0, Vec2(0, 0));
  for (std::int16_t& depth : blind.view.depths) depth = kBlindDepth;
  EXPECT_TRUE(at_start.add(blind));
  EXPECT_TRUE(elsewhere.add(blind));
  EXPECT_GT(at_start.knowledge().field->distance(Vec2(0, 0)), 1.5);
  EXPECT_EQ(at_start.knowledge().clear_radius, 2.0);
  EXPECT_EQ(elsewhere.knowledge().field->distance(Vec2(0, 0)), 0.0);
  EXPECT_EQ(elsewhere.knowledge().clear_radius, 0.0);
}

TEST(UnseenWatch, UsesASensorAtMostOncePerPeriodAndNoTiltedFrame) {
  UnseenWatch watch(UnseenMovers{}, Vec3::Zero());
  EXPECT_TRUE(watch.add(open_frame(kZero, 0, Vec2(0, 0), 1)));
  EXPECT_FALSE(watch.add(open_frame(kZero + Duration{33'000}, 0, Vec2(0, 0), 2)));
  EXPECT_TRUE(watch.add(open_frame(kZero + Duration{33'000}, 1, Vec2(0, 0), 3)));
  EXPECT_TRUE(watch.add(open_frame(kZero + kTick, 0, Vec2(0, 0), 4)));
  SightingSet tilted = open_frame(kZero + kTick + kTick, 0, Vec2(0, 0), 5);
  const Eigen::Quaterniond q(tilted.view.q_WC[0], tilted.view.q_WC[1], tilted.view.q_WC[2], tilted.view.q_WC[3]);
  const Eigen::Quaterniond turned = Eigen::AngleAxisd(0.3, Vec3::UnitY()) * q;
  tilted.view.q_WC = {turned.w(), turned.x(), turned.y(), turned.z()};
  EXPECT_FALSE(watch.add(tilted));
  EXPECT_EQ(watch.knowledge().pictures, 3);
  EXPECT_EQ(watch.knowledge().last, (MessageName{7, 4}));
  EXPECT_EQ(watch.knowledge().at, kZero + kTick);
}

TEST(UnseenWatch, UsesFramesOfABoundedNumberOfSensors) {
  UnseenWatch watch(UnseenMovers{}, Vec3::Zero());
  constexpr int kMost = static_cast<int>(UnseenWatch::kMostSensors);
  for (int sensor = 0; sensor < kMost; ++sensor) EXPECT_TRUE(watch.add(open_frame(kZero, sensor, Vec2(0, 0))));
  EXPECT_FALSE(watch.add(open_frame(kZero, kMost, Vec2(0, 0)))) << "an id per frame";
  UTime at = kZero + UnseenWatch::kSensorForgotten + kTick;
  EXPECT_TRUE(watch.add(open_frame(at, 0, Vec2(0, 0))));
  EXPECT_TRUE(watch.add(open_frame(at, kMost, Vec2(0, 0)))) << "the others are silent";
}

TEST(UnseenWatch, ItsWindowFollowsTheSensorAndKeepsWhatItKnew) {
  UnseenWatch watch(UnseenMovers{}, Vec3::Zero());
  UTime at = kZero;
  Vec2 p(0, 0);
  for (int k = 0; k < 60; ++k, at = at + kTick, p.x() += 0.3) {
    watch.add(open_frame(at, 0, p));
    const UnseenField& field = *watch.knowledge().field;
    EXPECT_NEAR(field.grid().origin.x() + kUnseenHalfWindow, p.x(),
                0.5 * UnseenWatch::kWindowStep * kUnseenCell + 1e-9);
    EXPECT_GT(field.distance(p), 3.5);
  }
  watch.add(open_frame(at, 0, Vec2(1e6, -1e6)));
  EXPECT_GT(watch.knowledge().field->distance(Vec2(1e6, -1e6)), 3.5) << "a sensor that jumps sees where it is then";
}

TEST(FirstContact, OfAPlanThatRestsIsNoneAndOfABlindOneIsZero) {
  TimedSpline rest;
  rest.start = kZero - Duration{2'000'000};
  rest.control_points = Points::Zero(3, 7);
  EXPECT_EQ(first_contact({}, rest, kZero, 0.1), kNoContact);
  TimedSpline moves = rest;
  moves.start = kZero;
  EXPECT_EQ(first_contact({}, moves, kZero, 0.1), 0.0);
}

struct Hidden {
  Vec2 p;
  bool is_out = false;  ///< seen

  [[nodiscard]] Square body() const { return {p - Vec2::Constant(0.2), p + Vec2::Constant(0.2)}; }
  /// Any part that a frame from there would show: points of the outline, nearer to each other than a cell's edge.
  void look_from(const Vec2& eye, const Corridor& corridor) {
    for (int k = 0; k < 16 && !is_out; ++k) {
      const double along = 0.1 * (k % 4) - 0.2;
      const Vec2 sides[] = {{along, -0.2}, {0.2, along}, {-along, 0.2}, {-0.2, -along}};
      const Vec2 to = p + sides[k / 4] - eye;
      is_out = corridor.range(eye, std::atan2(to.y(), to.x())) > to.norm();
    }
  }
  /// Along the wall to the gap, then at the vehicle.
  void walk(const Vec2& vehicle, const Corridor& corridor, double way) {
    const Vec2 towards = p.x() < corridor.gap + 0.25 ? Vec2(1, 0) : Vec2((vehicle - p).normalized());
    Hidden next{p + way * towards};
    if (corridor.has_room(next.body())) p = next.p;
  }
};

/// Frames of two sensors, the second one late, reach the watch at their own times.
class Frames {
 public:
  explicit Frames(Rng& rng) : latency_s_(rng.uniform(0.05, 0.25)) {}

  void take(UTime now, int sensor, const Vec2& eye, const Corridor& corridor) {
    SightingSet frame = frame_at(now, sensor, eye, [&](double azimuth) { return corridor.range(eye, azimuth); });
    under_way_.emplace_back(now + Duration::from_seconds(sensor == 1 ? latency_s_ : 0.02), std::move(frame));
  }
  void deliver(UTime now, UnseenWatch& watch) {
    std::erase_if(under_way_, [&](const auto& taken) {
      if (taken.first > now) return false;
      watch.add(taken.second);
      return true;
    });
  }

 private:
  double latency_s_;
  std::vector<std::pair<UTime, SightingSet>> under_way_;
};

/// Somebody of the largest speed, unseen so far, is never nearer than the field says.
TEST(UnseenWatch, NoAdversaryBehindAWallIsNearerThanItSaysByLateFramesOfTwoSensors) {
  std::int64_t checks = 0;
  double slack = 10.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    UnseenMovers movers;
    movers.max_speed_mps = rng.uniform(0.5, 2.5);
    movers.clear_radius_m = 0.5;  // they begin behind the wall, beyond that
    const Corridor corridor(rng);
    Frames frames(rng);
    std::vector<Hidden> all;
    for (int k = 0; k < 60; ++k) {
      all.push_back({Vec2(rng.uniform(-4, corridor.gap - 0.3), corridor.wall + rng.uniform(0.45, 1.5))});
    }
    UnseenWatch watch(movers, Vec3::Zero());
    Vec2 p(0, 0);
    for (int tick = 0; tick < 60; ++tick, p.x() += 0.1) {
      const UTime now = kZero + Duration{tick * 50'000};
      frames.take(now, tick % 2, p, corridor);
      for (Hidden& mover : all) mover.look_from(p, corridor);
      frames.deliver(now, watch);
      for (Hidden& mover : all) {
        if (!mover.is_out && watch.knowledge().field) {
          const Vec2 probe = p + Vec2(rng.uniform(-2, 2), rng.uniform(-0.9, 0.9));
          const double since = (now - watch.knowledge().at).seconds(), away = mover.body().exteriorDistance(probe);
          const double said = watch.knowledge().field->distance(probe) - movers.max_speed_mps * since;
          ASSERT_LE(said, away + 1e-9) << "seed " << seed << ", tick " << tick;
          slack = std::min(slack, away - said);
          ++checks;
        }
        mover.walk(p, corridor, movers.max_speed_mps * 0.05);
      }
    }
  }
  EXPECT_GT(checks, 5'000);
  EXPECT_LT(slack, 0.6) << "some adversary is nearly as near as the field allows";
}

}  // namespace
}  // namespace tern
