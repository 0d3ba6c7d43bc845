#include <gtest/gtest.h>

#include "tests/messages/spoiled_messages.h"

namespace tern {
namespace {

TEST(Rejection, OfSightingSet) {
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.left_out = -1; }), "Number");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.kind = static_cast<ViewKind>(2); }), "Enumeration");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.sensor_position.x() = kNaN; }), "Number");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.q_WC *= 0.9; }), "Inconsistent");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.range_m = 0.0; }), "Number");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.left = 4.0; }), "Number");
  EXPECT_EQ(after<SightingSet>([](auto& s) {
              s.view.kind = ViewKind::Pinhole;
              s.view.left = 1.6;
            }),
            "Inconsistent");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.view.rows += 1; }), "Inconsistent");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.sightings[1].upper = s.sightings[1].lower - Vec3(0.0, 1e-9, 0.0); }),
            "Inconsistent");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.sightings[1].lower_sigma.z() = -1.0; }), "Number");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.sightings[1].bounds[5] = static_cast<BoundSight>(6); }), "Enumeration");
  EXPECT_EQ(after<SightingSet>([](auto& s) { s.sightings[0].points = 0; }), "Number");
}

TEST(Rejection, OfPlanHeading) {
  EXPECT_EQ(after<PlanHeading>([](auto& h) { h.request_id = 0; }), "Number");
  EXPECT_EQ(after<PlanHeading>([](auto& h) { h.rate_max = 0.0; }), "Number");
  EXPECT_EQ(after<PlanHeading>([](auto& h) { h.control_points[1] = kNaN; }), "Number");
  EXPECT_EQ(after<PlanHeading>([](auto& h) { h.track_term = kInfinity; }), "Number");
  EXPECT_EQ(after<PlanHeading>([](auto& h) { h.interval.us = 0; }), "Time");
}

TEST(Rejection, OfPlanUnseen) {
  EXPECT_EQ(after<PlanUnseen>([](auto& u) { u.request_id = 0; }), "Number");
  EXPECT_EQ(after<PlanUnseen>([](auto& u) { u.start.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<PlanUnseen>([](auto& u) { u.committed_clear.us = -1; }), "Time");
  EXPECT_EQ(after<PlanUnseen>([](auto& u) { u.plan_clear.us = kMaxSpan.us + 1; }), "Time");
}

TEST(Rejection, OfPoseError) {
  EXPECT_EQ(after<PoseError>([](auto& e) { e.set = 0; }), "Number");
  EXPECT_EQ(after<PoseError>([](auto& e) { e.position.y() = kNaN; }), "Number");
  EXPECT_EQ(after<PoseError>([](auto& e) { e.pose_covariance[35] = kInfinity; }), "Number");
  EXPECT_EQ(after<PoseError>([](auto& e) { e.apart = -0.1; }), "Number");
}

TEST(Rejection, OfLandmarkDensities) {
  EXPECT_EQ(after<LandmarkDensities>([](auto& d) { d.densities.obstacles = -1.0; }), "Number");
  EXPECT_EQ(after<LandmarkDensities>([](auto& d) { d.densities.by_class[0] = kNaN; }), "Number");
  EXPECT_EQ(after<LandmarkDensities>([](auto& d) { ++d.tracks; }), "Inconsistent") << "statics names another pair";
}

TEST(Rejection, OfMapFile) {
  EXPECT_EQ(after<MapFile>([](auto& f) { f.at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<MapFile>([](auto& f) { f.format = static_cast<MapFormat>(1); }), "Enumeration");
  EXPECT_EQ(after<MapFile>([](auto& f) { f.origin.y() = kNaN; }), "Number");
  EXPECT_EQ(after<MapFile>([](auto& f) { f.parts = 0; }), "Number");
  EXPECT_EQ(after<MapFile>([](auto& f) { f.part = f.parts; }), "Inconsistent");
}

TEST(Rejection, OfFenceSet) {
  const auto with = [](const auto& shape) {
    return after<FenceSet>([&](FenceSet& set) {
      set.fences.resize(1);
      set.fences[0].shape = shape;
    });
  };
  const Eigen::Vector2d a(0, 0), b(1, 0), nowhere(kNaN, 0);
  EXPECT_EQ(with(FenceCircle{a, 1.0}), "accepted");
  EXPECT_EQ(with(FenceCircle{a, 0.0}), "Number");
  EXPECT_EQ(with(FenceCircle{a, kNaN}), "Number");
  EXPECT_EQ(with(FenceCircle{nowhere, 1.0}), "Number");
  EXPECT_EQ(with(FencePolygon{{a, b}}), "Number");
  EXPECT_EQ(with(FencePolygon{{a, b, nowhere}}), "Number");
  EXPECT_EQ(with(FencePolygon{{a, b, 2e6 * b}}), "Number");
}

TEST(Rejection, OfImuBatch) {
  EXPECT_EQ(after<ImuBatch>([](auto& b) { b.samples[1].at = b.samples[0].at; }), "Time");
  EXPECT_EQ(after<ImuBatch>([](auto& b) { b.samples[1].specific_force.x() = kNaN; }), "Number");
  EXPECT_EQ(after<ImuBatch>([](auto& b) { b.saturation_rate = -1.0; }), "Number");
}

TEST(Rejection, OfFeatureFrame) {
  EXPECT_EQ(after<FeatureFrame>([](auto& f) { f.features[1].id = f.features[0].id; }), "Inconsistent");
  EXPECT_EQ(after<FeatureFrame>([](auto& f) { f.features[1].left.x() = kNaN; }), "Number");
  EXPECT_EQ(after<FeatureFrame>([](auto& f) { f.features[0].id = -1; }), "Number");
  EXPECT_EQ(after<FeatureFrame>([](auto& f) { f.baseline_m = 0.0; }), "Number");
  EXPECT_EQ(after<FeatureFrame>([](auto& f) { f.q_BC *= 0.5; }), "Inconsistent");
}

TEST(Rejection, OfPositionFix) {
  EXPECT_EQ(after<PositionFix>([](auto& f) { f.variance.y() = 0.0; }), "Number");
  EXPECT_EQ(after<PositionFix>([](auto& f) { f.yaw = 3.2; }), "Number");
  EXPECT_EQ(after_flag_of_two<PositionFix>([](auto& f, bool on) { f.has_yaw = on; }), "Enumeration");
}

TEST(Rejection, OfOdometry) {
  EXPECT_EQ(after<Odometry>([](auto& o) { o.state = static_cast<EstimatorState>(4); }), "Enumeration");
  EXPECT_EQ(after<Odometry>([](auto& o) { o.pose_covariance[7] = kNaN; }), "Number");
  EXPECT_EQ(after<Odometry>([](auto& o) { o.q_OB *= 0.5; }), "Inconsistent");
  EXPECT_EQ(after<Odometry>([](auto& o) { o.epoch = -1; }), "Number");
  EXPECT_EQ(after<Odometry>([](auto& o) { o.yaw_WO = -3.2; }), "Number");
}

}  // namespace
}  // namespace tern
