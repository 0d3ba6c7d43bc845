// OBSTACLE_SIGHTINGS at tern-predictor's node: what becomes of good frames, and of bad ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "messages/batching.h"
#include "messages/channels.h"
#include "predictor/app/predictor_node.h"
#include "runtime/virtual_runner.h"
#include "tests/predictor/rendered_sightings.h"

namespace tern {
namespace {

using testing::RenderingSensor;

const Vec3 kEye(0, 0, 2);
const Box kCube = box_around(Vec3(5, 0.5, 2), Vec3::Constant(0.4));
constexpr double kRate = 30.0;

class SightingsInput : public ::testing::Test {
 protected:
  void SetUp() override {
    runner_.start("tern-predictor", [&](Bus& bus) {
      auto node = std::make_unique<PredictorNode>(bus, PredictorConfig{});
      node_ = node.get();
      bus_ = &bus;
      return node;
    });
    runner_.observer().subscribe(channels::kPredictions, [this](const TrackSet& batch) {
      if (auto set = collector_.add(batch)) last_ = join_batches(std::move(*set));
    });
    runner_.run(runner_.now() + Duration{1'000'000});
  }
  [[nodiscard]] SightingSet seen(RenderingSensor& sensor, double yaw = 0.0, Duration age = Duration{50'000}) {
    return sensor.frame(runner_.now() - age, kEye, yaw, {kCube});
  }
  void send(const SightingSet& frame) { runner_.observer().publish(channels::kObstacleSightings, frame); }
  void next_frame() { runner_.run(runner_.now() + Duration::from_seconds(1.0 / kRate)); }
  void watch(RenderingSensor& sensor, double seconds) {
    for (int k = 0; k < static_cast<int>(seconds * kRate); ++k) {
      send(seen(sensor));
      next_frame();
    }
  }
  // Whether a published box contains the cube's near face; one that says "something may be anywhere" does not count.
  [[nodiscard]] bool knows_the_cube() const {
    return std::ranges::any_of(last_.tracks, [](const Track& track) {
      const Box box = track.bounds(track.motion.start, track.motion.start);
      return box.contains(kCube.center() - Vec3(0.4, 0, 0)) && box.sizes().maxCoeff() < 10.0;
    });
  }
  [[nodiscard]] bool says(const std::string& words) const {
    return node_->health().waiting_for.find(words) != std::string::npos;
  }
  [[nodiscard]] std::int64_t late() const { return bus_->counters().at("OBSTACLE_SIGHTINGS").late; }

  VirtualRunner runner_;
  PredictorNode* node_ = nullptr;
  Bus* bus_ = nullptr;
  BatchCollector<TrackSet> collector_;
  TrackSet last_;
  RenderingSensor camera_ = RenderingSensor::camera(0), other_ = RenderingSensor::camera(1);
};

TEST_F(SightingsInput, BecomePredictions) {
  watch(camera_, 1.0);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  ASSERT_EQ(last_.tracks.size(), 1u);
  EXPECT_EQ(last_.tracks.front().kind, TrackKind::Estimated);
  EXPECT_TRUE(knows_the_cube());
}

TEST_F(SightingsInput, ASilentCameraIsNamed) {
  watch(camera_, 1.0);
  runner_.run(runner_.now() + Duration::from_seconds(1.0));
  EXPECT_TRUE(says("obstacle sightings of sensor 0 (silent for")) << node_->health().waiting_for;
}

TEST_F(SightingsInput, ADepthThatIsAllZerosCostsNoTrack) {
  watch(camera_, 1.0);
  for (int k = 0; k <= kMissesToDelete; ++k) {
    SightingSet blind = seen(camera_);
    blind.sightings.clear();
    std::ranges::fill(blind.view.depths, kBlindDepth);
    send(blind);
    next_frame();
  }
  EXPECT_TRUE(knows_the_cube());
}

TEST_F(SightingsInput, ABoundThatIsNaNIsRefusedAndCostsNoTrack) {
  watch(camera_, 1.0);
  SightingSet broken = seen(camera_);
  ASSERT_FALSE(broken.sightings.empty());
  broken.sightings.front().lower.x() = std::numeric_limits<double>::quiet_NaN();
  send(broken);
  next_frame();
  const auto& rejected = bus_->counters().at("OBSTACLE_SIGHTINGS").rejected;
  EXPECT_EQ(std::accumulate(std::begin(rejected), std::end(rejected), std::int64_t{0}), 1);
  EXPECT_TRUE(knows_the_cube());
}

// The sensor sees a part of the vehicle that carries it, in each frame. The cube is tracked as well.
TEST_F(SightingsInput, ASensorThatCoversItselfCostsNoOtherTrack) {
  for (int k = 0; k < 30; ++k) {
    SightingSet frame = seen(camera_);
    Sighting own;
    own.lower = kEye + Vec3(0.25, -0.1, -0.3);
    own.upper = kEye + Vec3(0.25, 0.1, -0.2);
    own.lower_sigma = own.upper_sigma = Vec3::Constant(0.01);
    own.bounds.fill(BoundSight::Whole);
    own.points = 200;
    frame.sightings.push_back(own);
    send(frame);
    next_frame();
  }
  EXPECT_TRUE(knows_the_cube());
  EXPECT_EQ(last_.tracks.size(), 2u);
}

TEST_F(SightingsInput, AViewWithoutDepthsCostsNoTrack) {
  watch(camera_, 1.0);
  for (int k = 0; k <= kMissesToDelete; ++k) {
    SightingSet bare = seen(camera_);
    bare.sightings.clear();
    bare.view.depths.clear();
    bare.view.rows = bare.view.columns = 0;
    send(bare);
    next_frame();
  }
  EXPECT_TRUE(knows_the_cube());
}

TEST_F(SightingsInput, APoseThatIsWrongByFiveDegrees) {
  const double wrong = 5.0 * std::numbers::pi / 180.0;
  RenderingSensor turned = RenderingSensor::camera(0);
  const Eigen::AngleAxisd turn(wrong, Vec3::UnitZ());
  for (int k = 0; k < 60; ++k) {
    SightingSet frame = seen(turned, wrong);
    // The sender believes that it looks along x, so all that it saw is turned by −5° about it.
    for (Sighting& sighting : frame.sightings) {
      const Vec3 moved = turn.inverse() * (0.5 * (sighting.lower + sighting.upper) - kEye) + kEye -
                         0.5 * (sighting.lower + sighting.upper);
      sighting.lower += moved;
      sighting.upper += moved;
    }
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(turn.inverse()) *
        Eigen::Quaterniond(frame.view.q_WC[0], frame.view.q_WC[1], frame.view.q_WC[2], frame.view.q_WC[3]);
    frame.view.q_WC = {q.w(), q.x(), q.y(), q.z()};
    send(frame);
    send(seen(other_));
    next_frame();
  }
  EXPECT_TRUE(knows_the_cube()) << "the other camera is believed as well";
  EXPECT_EQ(late(), 0);
}

TEST_F(SightingsInput, AClockThatIsEightyMillisecondsOff) {
  for (int k = 0; k < 60; ++k) {
    send(seen(camera_, 0.0, Duration{130'000}));
    send(seen(other_));
    next_frame();
  }
  EXPECT_EQ(late(), 0);
  EXPECT_TRUE(knows_the_cube());
}

TEST_F(SightingsInput, APictureThatIsSentAgainIsLateAndSaid) {
  const SightingSet frozen = seen(camera_);
  for (int k = 0; k < 5; ++k) {
    send(frozen);
    next_frame();
  }
  EXPECT_EQ(late(), 4);
  EXPECT_TRUE(says("obstacle sightings of sensor 0: two sets of one time")) << node_->health().waiting_for;
}

TEST_F(SightingsInput, BoundsThatAreTooUncertainAreNotUsed) {
  SightingSet vague = seen(camera_);
  ASSERT_FALSE(vague.sightings.empty());
  vague.sightings.front().upper_sigma.y() = 100.0;
  send(vague);
  next_frame();
  next_frame();
  EXPECT_TRUE(last_.tracks.empty());
  EXPECT_TRUE(says("standard deviation above")) << node_->health().waiting_for;
}

// A sighting inside a declared track is that track. The part of a sighting that sticks out is another obstacle.
TEST_F(SightingsInput, WhatIsDeclaredIsNotSeenTwice) {
  Track declared;
  declared.id = 5;
  declared.kind = TrackKind::Static;
  declared.half_extents = Vec3::Constant(0.45);
  declared.alpha = {Vec3::Zero()};
  declared.motion.start = runner_.now();
  CubicPiece piece{Duration{1'000'000}, PowerCubic::Zero()};
  piece.coefficients.col(3) = kCube.center();
  declared.motion.pieces.push_back(piece);
  TrackSet set;
  set.batch.set = 1;
  set.made_at = runner_.now();
  set.tracks = {declared};
  runner_.observer().publish_paced(channels::kDeclaredMotions, split_batches(set));
  next_frame();
  watch(camera_, 0.5);
  ASSERT_EQ(last_.tracks.size(), 1u);
  EXPECT_EQ(last_.tracks.front().id, 5);
}

}  // namespace
}  // namespace tern
