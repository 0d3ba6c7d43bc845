#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/base/digest.h"
#include "core/wire/message_limits.h"
#include "messages/wire.h"
#include "tern_msgs/exposure_t.hpp"
#include "tern_msgs/flight_result_t.hpp"
#include "tern_msgs/heartbeat_t.hpp"
#include "tern_msgs/map_chunk_t.hpp"
#include "tern_msgs/track_set_t.hpp"
#include "tests/messages/spoiled_messages.h"

namespace tern {
namespace {

template <class T>
class EveryMessage : public testing::Test {};
TYPED_TEST_SUITE(EveryMessage, AllMessages);

TYPED_TEST(EveryMessage, OfAnotherFingerprintIsRefused) {
  Bytes bytes = encode(rich_message<TypeParam>());
  bytes[3] ^= 1U;
  EXPECT_EQ(verdict<TypeParam>(bytes), "Fingerprint");
}

TYPED_TEST(EveryMessage, OfAnotherLengthIsRefused) {
  const Bytes bytes = encode(rich_message<TypeParam>());
  for (std::size_t n = 0; n < bytes.size(); n += n < 64 ? 1 : 97) {
    EXPECT_EQ(verdict<TypeParam>(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n))), "Length") << n;
  }
  Bytes longer = bytes;
  longer.push_back(0);
  EXPECT_EQ(verdict<TypeParam>(longer), "Length");
}

TYPED_TEST(EveryMessage, OfAnIllegalCountIsRefused) {
  const auto value = rich_message<TypeParam>();
  for (std::size_t k = 0; k < array_sizes(value).size(); ++k) {
    for (const std::uint32_t count : {0x40000001U, 0xFFFFFFFFU, 0x80000000U, 0x7FFFFFFFU, 0x00010000U}) {
      Bytes bytes = encode(value);
      for (std::size_t i = 0; i < 4; ++i) {
        bytes[wire::kFingerprintBytes + 4 * k + i] = static_cast<std::uint8_t>(count >> (24 - 8 * i));
      }
      EXPECT_EQ(verdict<TypeParam>(bytes), "Count") << k << " " << count;
    }
  }
}

TYPED_TEST(EveryMessage, WithoutANameOrATimeIsRefused) {
  EXPECT_EQ(after<TypeParam>([](auto& v) { v.header.name.sequence = 0; }), "Number");
  EXPECT_EQ(after<TypeParam>([](auto& v) { v.header.name.sequence = -1; }), "Number");
  EXPECT_EQ(after<TypeParam>([](auto& v) { v.header.name.sender_epoch_us = -1; }), "Time");
  EXPECT_EQ(after<TypeParam>([](auto& v) { v.header.utime.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<TypeParam>([](auto& v) { v.header.utime.us = kFarPast; }), "Time");
}

TEST(Rejection, OfUavState) {
  EXPECT_EQ(after<UavState>([](auto& s) { s.motion.p.x() = kNaN; }), "Number");
  EXPECT_EQ(after<UavState>([](auto& s) { s.motion.j.z() = kInfinity; }), "Number");
  EXPECT_EQ(after<UavState>([](auto& s) { s.yaw = 3.2; }), "Number");
  EXPECT_EQ(after<UavState>([](auto& s) { s.at.us = kFarPast; }), "Time");
}

TEST(Rejection, OfGoal) {
  EXPECT_EQ(after<Goal>([](auto& g) { g.id = 0; }), "Number");
  EXPECT_EQ(after<Goal>([](auto& g) { g.id = kMaxGoalId + 1; }), "Number");
  EXPECT_EQ(after<Goal>([](auto& g) { g.id = std::numeric_limits<std::int64_t>::max(); }), "Number");
  EXPECT_EQ(after<Goal>([](auto& g) { g.position.y() = 1.1e6; }), "Number");
  EXPECT_EQ(after<Goal>([](auto& g) { g.mode = static_cast<GoalMode>(3); }), "Enumeration");
  EXPECT_EQ(after<Goal>([](auto& g) { g.mode = static_cast<GoalMode>(255); }), "Enumeration");
}

TEST(Rejection, OfSpeedLimit) {
  EXPECT_EQ(after<SpeedLimit>([](auto& s) { s.goal_id = 0; }), "Number");
  EXPECT_EQ(after<SpeedLimit>([](auto& s) { s.v_max.x() = 0.04; }), "Number");
  EXPECT_EQ(after<SpeedLimit>([](auto& s) { s.v_max.z() = kNaN; }), "Number");
}

TEST(Rejection, OfCloudScan) {
  EXPECT_EQ(after<CloudScan>([](auto& s) { s.at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<CloudScan>([](auto& s) { s.sensor_id = -1; }), "Number");
  EXPECT_EQ(after<CloudScan>([](auto& s) { s.range_m = kNaN; }), "Number");
  EXPECT_EQ(after<CloudScan>([](auto& s) { s.sensor_position.z() = kInfinity; }), "Number");
  EXPECT_EQ(after<CloudScan>([](auto& s) { s.points[0].position.x() = std::numeric_limits<float>::quiet_NaN(); }),
            "accepted")
      << "no measurement";
  EXPECT_EQ(after_flag_of_two<CloudScan>([](auto& s, bool on) { s.has_classes = on; }), "Enumeration");
}

TEST(Rejection, OfDepthImage) {
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.sensor_id = -1; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.range_m = -1.0; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.sensor_position.x() = kNaN; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.q_WC[1] = kNaN; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.q_WC *= 0.9; }), "Inconsistent");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.fx = 0.0; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.fy = -1.0; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.cx = kNaN; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.cy = kInfinity; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.unit_m = 0.0; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.width = 0; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.first_row = -1; }), "Number");
  EXPECT_EQ(after<DepthImage>([](auto& i) { i.width = static_cast<int>(i.depths.size()) - 1; }), "Inconsistent");
}

TEST(Rejection, OfObservationSet) {
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.sensor_id = -1; }), "Number");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.range_m = -1.0; }), "Number");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[1].half_extents.x() = -1e-9; }), "Number");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[1].variance.x() = -1e-9; }), "Number");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[1].track_id = -2; }), "Number");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[0].track_id = s.detections[1].track_id = 5; }),
            "Inconsistent");
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[0].track_id = s.detections[1].track_id = kNoTrackId; }),
            "accepted");
}

TEST(Rejection, LeavesOutDetectionsThatAreAtNoPlaceAndAtMostAllButOne) {
  const auto original = rich_message<ObservationSet>();
  for (const double nowhere : {kNaN, kInfinity, 1.1e6}) {
    auto set = original;
    set.detections[1].position.y() = nowhere;
    set.detections[1].variance.x() = kNaN;
    const auto decoded = decode<ObservationSet>(encode(set));
    ASSERT_TRUE(decoded);
    auto others = original;
    others.detections.erase(others.detections.begin() + 1);
    EXPECT_EQ(words_of(*decoded), words_of(others));
  }
  EXPECT_EQ(after<ObservationSet>([](auto& s) {
              for (Detection& detection : s.detections) detection.position.x() = kNaN;
            }),
            "Number")
      << "a sensor that knows no place sees nothing, but does not say that nothing is there";
  EXPECT_EQ(after<ObservationSet>([](auto& s) { s.detections[1].variance.x() = kNaN; }), "Number")
      << "without it, the vehicle would fly through what is there";
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[1].motion.pieces[0].coefficients(0, 0) = kNaN; }), "Number");
}

TEST(Rejection, OfTrackSet) {
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.batch.set = 0; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.batch.count = kMaxBatches + 1; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.batch.index = -1; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.batch = {1, 2, 2}; }), "Inconsistent");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.made_at.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.confidence = 0.0; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.confidence = 1.0 + 1e-15; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.left_out = -1; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].id = -1; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].id = s.tracks[1].id; }), "Inconsistent");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].kind = static_cast<TrackKind>(3), s.tracks[0].shares.clear(); }),
            "Enumeration");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].half_extents.z() = -1.0; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].top_speed = kInfinity; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].alpha[0].x() = -1.0; }), "Number");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].motion.start.us = kFarPast; }), "Time");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].motion.pieces[0].duration.us = 0; }), "Time");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].motion.pieces[0].duration.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<TrackSet>([](auto& s) { s.tracks[0].motion.pieces[0].coefficients(1, 3) = kNaN; }), "Number");
}

TEST(Rejection, OfTracksWhosePiecesDoNotAddUp) {
  using Wire = tern_msgs::track_set_t;
  const auto after_wire = after_on_wire<TrackSet, Wire>;
  EXPECT_EQ(after_wire([](Wire& m) { ++m.tracks[0].piece_count; }), "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) { m.tracks[1].piece_count = kMaxPiecesPerBatch; }), "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) { m.tracks[0].piece_count = 0; }), "Number");
  EXPECT_EQ(after_wire([](Wire& m) { m.tracks[0].piece_count = std::numeric_limits<std::int32_t>::min(); }), "Number");
}

TEST(Rejection, OfSharesThatNoDistributionHas) {
  const auto after_shares = [](const AlphaShares& shares) {
    return after<TrackSet>([&](auto& s) {
      s.tracks[0].kind = TrackKind::Estimated;
      s.tracks[0].shares.assign(s.tracks[0].alpha.size(), shares);
    });
  };
  EXPECT_EQ(after_shares(on_all_axes({1.0F, 1.0F, 1.0F, 1.0F})), "accepted");
  EXPECT_EQ(after_shares(on_all_axes({0.9F, 0.8F, 0.8F, 1e-6F})), "accepted");
  EXPECT_EQ(after_shares(on_all_axes({0.9F, 0.8F, 0.8F, 0.0F})), "Number");
  EXPECT_EQ(after_shares(on_all_axes({1.1F, 0.8F, 0.8F, 0.5F})), "Number");
  EXPECT_EQ(after_shares(on_all_axes({std::numeric_limits<float>::quiet_NaN(), 0.8F, 0.8F, 0.5F})), "Number");
  EXPECT_EQ(after_shares(on_all_axes({0.9F, 0.8F, 0.81F, 0.5F})), "Inconsistent");
  AlphaShares per_axis = on_all_axes({0.9F, 0.8F, 0.7F, 0.6F});
  per_axis[1] = {0.9F, 0.75F, 0.8F};
  EXPECT_EQ(after_shares(per_axis), "accepted");
  per_axis[2][1] = 0.76F;
  EXPECT_EQ(after_shares(per_axis), "Inconsistent") << "those of y grow";
  using Wire = tern_msgs::track_set_t;
  const auto after_wire = after_on_wire<TrackSet, Wire>;
  EXPECT_EQ(after_wire([](Wire& m) {
              m.shares.push_back({{1.0F, 1.0F, 1.0F, 1.0F}}), ++m.share_count;
            }),
            "Inconsistent");
}

TEST(Rejection, OfAStaticTrackThatMoves) {
  const auto make_static = [](Track& track, int pieces) {
    track.kind = TrackKind::Static;
    track.motion.pieces.assign(static_cast<std::size_t>(pieces), CubicPiece{Duration{1}, PowerCubic::Zero()});
    track.alpha.assign(track.motion.pieces.size(), Vec3::Zero());
    track.shares.clear();
  };
  EXPECT_EQ(after<TrackSet>([&](auto& s) { make_static(s.tracks[0], 1); }), "accepted");
  EXPECT_EQ(after<TrackSet>([&](auto& s) { make_static(s.tracks[0], 2); }), "Inconsistent");
  EXPECT_EQ(after<TrackSet>([&](auto& s) {
              make_static(s.tracks[0], 1);
              s.tracks[0].motion.pieces[0].coefficients(2, 2) = 1e-300;
            }),
            "Inconsistent");
}

TEST(Rejection, OfMapChunk) {
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.version = 0; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.grid.resolution = 0.0; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.grid.origin.setConstant(1e6 - 1e-3); }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.grid.size.x() = -1; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.grid.size.setConstant(200'000'000); }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) {
              c.grid.resolution = 0.01;
              c.grid.size = {20'001, 10'000, 1};
            }),
            "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.count = kMaxMapChunks + 1; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.index = c.count = 4; }), "Inconsistent");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.first_voxel = -1; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.first_voxel = c.grid.voxels(); }), "Inconsistent");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.runs[0].length = 0; }), "Number");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.runs[0].length = 199'999'999; }), "Inconsistent");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.runs[1].label = static_cast<VoxelLabel>(5); }), "Enumeration");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.runs[1].class_index = static_cast<std::uint8_t>(c.class_names.size()); }),
            "Inconsistent");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.class_names[0] = "water"; }), "Inconsistent");
  EXPECT_EQ(after<MapChunk>([](auto& c) { c.class_names[1] = "wa\x1b[2Jter"; }), "Number");
  using Wire = tern_msgs::map_chunk_t;
  const auto after_wire = after_on_wire<MapChunk, Wire>;
  EXPECT_EQ(after_wire([](Wire& m) { --m.class_lengths.back(); }), "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) { m.class_lengths.back() = 8000; }), "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) { m.class_lengths.back() = -1; }), "Number");
}

TEST(Rejection, OfHorizonRequest) {
  using Request = HorizonRequest;
  EXPECT_EQ(after<Request>([](auto& r) { r.tube.z() = -1e-9; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.tube.x() = kNaN; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.id = -1; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.t_s.us = kFarPast; }), "Time");
  EXPECT_EQ(after<Request>([](auto& r) { r.deadline = r.t_s - Duration{4'999}; }), "Time");
  EXPECT_EQ(after<Request>([](auto& r) {
              r.t_s = r.committed.start - Duration{1};
              r.deadline = r.t_s - Duration{10'000};
            }),
            "Time");
  EXPECT_EQ(after<Request>([](auto& r) { r.committed.interval.us = 0; }), "Time");
  EXPECT_EQ(after<Request>([](auto& r) { r.committed.interval = kMaxIntervalDuration + Duration{1}; }), "Time");
  EXPECT_EQ(after<Request>([](auto& r) { r.committed.control_points(0, 3) = kNaN; }), "Number");
  EXPECT_EQ(
      after<Request>([](auto& r) { r.committed.control_points(0, r.committed.control_points.cols() - 1) += 1e-9; }),
      "Inconsistent");
  EXPECT_EQ(after<Request>([](auto& r) { r.start.p.x() += 2e-6; }), "Inconsistent");
  EXPECT_EQ(after<Request>([](auto& r) { r.start.v.y() += 2e-6; }), "Inconsistent");
  EXPECT_EQ(after<Request>([](auto& r) { r.start.a.z() += 2e-6; }), "Inconsistent");
  EXPECT_EQ(after<Request>([](auto& r) { r.start.j.z() += 1.0; }), "accepted");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.v_max.x() = kInfinity; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.v_max.x() = std::nextafter(kMaxSpeedLimit, kInfinity); }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.a_max.x() = 0.0; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.a_max.x() = std::nextafter(kMaxAccelerationLimit, kInfinity); }),
            "Number");
  for (Vec3 Limits::*limit : {&Limits::v_max, &Limits::a_max, &Limits::j_max}) {
    EXPECT_EQ(after<Request>([&](auto& r) { (r.limits.*limit).y() = kMinLimit; }), "accepted");
    EXPECT_EQ(after<Request>([&](auto& r) { (r.limits.*limit).y() = std::nextafter(kMinLimit, 0.0); }), "Number");
  }
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.j_max.setConstant(kInfinity); }), "accepted");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.j_max.setConstant(1e300); }), "accepted");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.j_max.x() = -kInfinity; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.j_max.y() = kNaN; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.limits.dynamics = Dynamics{}; }), "accepted");
  for (const auto& [field, range] : {std::pair{&Dynamics::thrust_min, Dynamics::kThrustMin},
                                     {&Dynamics::thrust_max, Dynamics::kThrustMax},
                                     {&Dynamics::tilt_max_deg, Dynamics::kTilt},
                                     {&Dynamics::body_rate_max_deg_s, Dynamics::kBodyRate}}) {
    const auto with = [field = field](double value) {
      return after<Request>([&](auto& r) { r.limits.dynamics.emplace().*field = value; });
    };
    EXPECT_EQ(with(range.low), "accepted");
    EXPECT_EQ(with(range.high), "accepted");
    EXPECT_EQ(with(std::nextafter(range.low, -kInfinity)), "Number");
    EXPECT_EQ(with(std::nextafter(range.high, kInfinity)), "Number");
    EXPECT_EQ(with(kNaN), "Number");
  }
  EXPECT_EQ(after<Request>([](auto& r) { r.body.radius = -0.1; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.body.vertices(2, 0) = 1001.0; }), "Number");
  EXPECT_EQ(after<Request>([](auto& r) { r.flight_box = Box(Vec3(0, 0, 1), Vec3(1, 1, 0)); }), "Inconsistent");
  EXPECT_EQ(after<Request>([](auto& r) { r.flight_box.setEmpty(); }), "Number");
}

TEST(Rejection, OfPlan) {
  EXPECT_EQ(after<Plan>([](auto& p) { p.request_id = 0; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.outcome = static_cast<PlanOutcome>(kPlanOutcomes); }), "Enumeration");
  EXPECT_EQ(after<Plan>([](auto& p) { p.reason = static_cast<PlanReason>(kPlanReasons); }), "Enumeration");
  EXPECT_EQ(after<Plan>([](auto& p) { p.trajectory.start.us = kFarFuture; }), "Time");
  EXPECT_EQ(after<Plan>([](auto& p) { p.trajectory.interval.us = -1; }), "Time");
  EXPECT_EQ(after<Plan>([](auto& p) { p.trajectory.control_points(2, 6) = -kInfinity; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.hold.us = -1; }), "Time");
  EXPECT_EQ(after<Plan>([](auto& p) { p.sphere_radius = -1.0; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cost.jerk = -1.0; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cost.total = kInfinity; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cost.repulsion = kNaN; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.goal.sequence = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.predictions.sender_epoch_us = -1; }), "Time");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.prediction_set = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.left_out = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.goal_field.statics_epoch_us = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.goal_field.statics_first_set = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.goal_field.vehicle.sequence = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.inputs.request = {0, 0}; }), "accepted");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].plane.n *= 1.0 + 3e-6; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].plane.n.setConstant(kNaN); }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].plane.d = 2e7; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].track = kFarPast; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) {
              p.certificate[1].interval = static_cast<std::int16_t>(p.trajectory.control_points.cols() - 3);
            }),
            "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].interval = -1; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].parts = 3; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.certificate[1].part = p.certificate[1].parts; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cuts[0].stage = static_cast<Stage>(kStages); }), "Enumeration");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cuts[0].phase = static_cast<Phase>(kPhases); }), "Enumeration");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cuts[0].attempt = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cuts[0].attempt = kMaxAttempts; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.standing = -1; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.cuts[0].count = -1; }), "Number");
  EXPECT_EQ(after_flag_of_two<Plan>([](Plan& p, bool flag) { p.relaxed = flag; }), "Enumeration");
  EXPECT_EQ(after<Plan>([](auto& p) { p.confidence = -1e-9; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.confidence = 1.0 + 1e-15; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.level = kLevels; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.alpha_scale = kNaN; }), "Number");
  EXPECT_EQ(after<Plan>([](auto& p) { p.level = kLevels - 1, p.alpha_scale = 0.5, p.confidence = 0.0; }), "accepted");
  EXPECT_EQ(after<Plan>([](auto& p) { p.level = kLevels - 1, p.alpha_scale = 0.5, p.confidence = 0.1; }),
            "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.level = 0, p.alpha_scale = 0.5, p.confidence = 0.0; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.sure_for = Duration{-1}; }), "Time");
  EXPECT_EQ(after<Plan>([](auto& p) { p.sure_for = Duration{0}, p.confidence = 0.6; }), "Inconsistent");
  EXPECT_EQ(after<Plan>([](auto& p) { p.sure_for = kMaxSpan + Duration{1}; }), "Time");
}

TEST(Rejection, OfSearchView) {
  EXPECT_EQ(after<SearchView>([](auto& v) { v.request_id = 0; }), "Number");
  EXPECT_EQ(after<SearchView>([](auto& v) { v.left_out = -1; }), "Number");
  EXPECT_EQ(after<SearchView>([](auto& v) { v.nodes = {{Vec3(0.0, kNaN, 0.0), -1}}; }), "Number");
  EXPECT_EQ(after<SearchView>([](auto& v) { v.nodes = {{Vec3::Zero(), -2}}; }), "Number");
  EXPECT_EQ(after<SearchView>([](auto& v) { v.nodes = {{Vec3::Zero(), 0}}; }), "Inconsistent");
}

TEST(Rejection, OfTrackBounds) {
  const auto with = [](const std::function<void(TrackBound&)>& spoil) {
    return after<TrackBounds>([&](auto& of) { spoil(of.bounds[1]); });
  };
  EXPECT_EQ(after<TrackBounds>([](auto& of) { of.confidence = 0.0; }), "Number");
  EXPECT_EQ(after<TrackBounds>([](auto& of) { of.left_out = -1; }), "Number");
  EXPECT_EQ(with([](TrackBound& b) { b.id = -1; }), "Number");
  EXPECT_EQ(with([](TrackBound& b) { b.kind = static_cast<MotionKind>(kMotionKinds); }), "Enumeration");
  EXPECT_EQ(with([](TrackBound& b) { b.ruled_by = static_cast<BoundRule>(kBoundRules); }), "Enumeration");
  EXPECT_EQ(with([](TrackBound& b) { b.model = -1.0; }), "Number");
  EXPECT_EQ(with([](TrackBound& b) { b.measured = kNaN; }), "Number");
  EXPECT_EQ(with([](TrackBound& b) { b.promised = kInfinity; }), "Number");
}

TEST(Rejection, OfPlanTiming) {
  EXPECT_EQ(after<PlanTiming>([](auto& t) { t.request_id = 0; }), "Number");
  EXPECT_EQ(after<PlanTiming>([](auto& t) { t.total_ms = -0.1; }), "Number");
  EXPECT_EQ(after<PlanTiming>([](auto& t) { t.stage_ms[kStages - 1] = kNaN; }), "Number");
  EXPECT_EQ(after<PlanTiming>([](auto& t) { t.peak_rss_kb = -1; }), "Number");
  EXPECT_EQ(after_flag_of_two<PlanTiming>([](PlanTiming& t, bool flag) { t.from_watchdog = flag; }), "Enumeration");
}

TEST(Rejection, OfHeartbeat) {
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.state = static_cast<ProcessState>(5); }), "Enumeration");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.channels.begin()->second.lost = -1; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.channels.begin()->second.rejected[kRejections - 1] = -1; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.channels = {{"", ChannelCounters{}}}; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.channels = {{std::string(64, 'x'), ChannelCounters{}}}; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.waiting_for = "\xC3"; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.echoes = {{0, {}, {}}}; }), "Number");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.echoes = {{1, {kFarPast}, {}}}; }), "Time");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.echoes = {{1, {}, {kFarPast}}}; }), "Time");
  EXPECT_EQ(after<Heartbeat>([](auto& h) { h.echoes = {{7, {}, {}}, {7, {}, {}}}; }), "Inconsistent");
  using Wire = tern_msgs::heartbeat_t;
  const auto after_wire = after_on_wire<Heartbeat, Wire>;
  EXPECT_EQ(after_wire([](Wire& m) {
              m.channels.resize(1);
              m.channel_count = 1;
              m.channels[0].name_length = 3;
              m.channel_text = {'A', 'B'};
              m.channel_text_count = 2;
            }),
            "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) {
              m.channels.resize(2);
              m.channel_count = 2;
              m.channels[0].name_length = m.channels[1].name_length = 1;
              m.channel_text = {'A', 'A'};
              m.channel_text_count = 2;
            }),
            "Inconsistent");
}

TEST(Rejection, OfConfigurationReport) {
  EXPECT_EQ(after<ConfigurationReport>([](auto& r) { ++r.hash; }), "Inconsistent");
  EXPECT_EQ(after<ConfigurationReport>([](auto& r) { r.yaml += ' '; }), "Inconsistent");
  EXPECT_EQ(after<ConfigurationReport>([](auto& r) { r.platform = std::string(1, '\0'); }), "Number");
  EXPECT_EQ(after<ConfigurationReport>([](auto& r) {
              r.yaml += '\0';
              r.hash = digest(r.yaml);
            }),
            "Number");
}

TEST(Rejection, OfObstacleTruth) {
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.at.us = kFarPast; }), "Time");
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.left_out = -1; }), "Number");
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.batch = {1, 5, 5}; }), "Inconsistent");
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.obstacles[0].id = -1; }), "Number");
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.obstacles[0].id = t.obstacles[1].id; }), "Inconsistent");
  EXPECT_EQ(after<ObstacleTruth>([](auto& t) { t.obstacles[0].velocity.x() = kNaN; }), "Number");
  EXPECT_EQ(after_flag_of_two<ObstacleTruth>([](ObstacleTruth& t, bool flag) { t.obstacles[0].moves = flag; }),
            "Enumeration");
}

TEST(Rejection, OfVehicleStatus) {
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.at.us = kFarPast; }), "Time");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.battery = 1.1; }), "Number");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.battery = kNaN; }), "Number");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.battery.reset(); }), "accepted");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.estimator = static_cast<EstimatorHealth>(3); }), "Enumeration");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.position_sigma.y() = -0.1; }), "Number");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.resets = -1; }), "Number");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.mode = "\xC3"; }), "Number");
  const auto following = [](bool armed, const char* why_not) {
    return after<VehicleStatus>([&](VehicleStatus& s) { s.following = true, s.armed = armed, s.why_not = why_not; });
  };
  EXPECT_EQ(following(true, ""), "accepted");
  EXPECT_EQ(following(false, ""), "Inconsistent");
  EXPECT_EQ(following(true, "a pilot flies"), "Inconsistent");
  EXPECT_EQ(after<VehicleStatus>([](auto& s) { s.following = false, s.why_not.clear(); }), "Inconsistent");
}

TEST(Rejection, OfFlightResult) {
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.outcome = static_cast<FlightOutcome>(4); }), "Enumeration");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.first_entry_s = kNaN; }), "accepted");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.first_entry_s = kInfinity; }), "Number");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.flight_time_s = -1.0; }), "Number");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.min_clearance_m = -2e7; }), "Number");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.min_map_clearance_m = 2e7; }), "Number");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.stops = -1; }), "Number");
  EXPECT_EQ(after<FlightResult>([](auto& r) { r.exposure[0].metres = kNaN; }), "Number");
  using Wire = tern_msgs::flight_result_t;
  const auto after_wire = after_on_wire<FlightResult, Wire>;
  EXPECT_EQ(after_wire([](Wire& m) { m.exposure[0].name_length = 16'000; }), "Inconsistent");
  EXPECT_EQ(after_wire([](Wire& m) { m.exposure[0].name_length = -1; }), "Number");
}

TEST(Rejection, NamesTheReasonThatComesFirstInTheOrderOfTheContract) {
  const auto number = [](Plan& p) { p.cost.jerk = kNaN; };
  const auto enumeration = [](Plan& p) { p.outcome = static_cast<PlanOutcome>(99); };
  const auto time = [](Plan& p) { p.trajectory.start.us = kFarFuture; };
  const auto inconsistent = [](Plan& p) { p.certificate[0].parts = 3; };
  EXPECT_EQ(after<Plan>([&](Plan& p) { inconsistent(p), time(p), enumeration(p), number(p); }), "Number");
  EXPECT_EQ(after<Plan>([&](Plan& p) { inconsistent(p), time(p), enumeration(p); }), "Enumeration");
  EXPECT_EQ(after<Plan>([&](Plan& p) { inconsistent(p), time(p); }), "Time");
}

TEST(Encoding, ThrowsOnACountBeyondItsLimit) {
  ObservationSet observations;
  observations.detections.resize(kMaxDetections + 1);
  EXPECT_THROW(encode(observations), std::invalid_argument);
  Plan plan;
  plan.trajectory.control_points = Points::Zero(3, kMinControlPoints - 1);
  EXPECT_THROW(encode(plan), std::invalid_argument);
  plan.trajectory.control_points = Points::Zero(3, kMaxControlPoints + 1);
  EXPECT_THROW(encode(plan), std::invalid_argument);
}

TEST(Encoding, ThrowsOnAMessageThatIsTooLong) {
  Rng rng(7);
  TrackSet set;
  for (int i = 0; i < 2; ++i) set.tracks.push_back(support::random_track(rng, i, kMaxPiecesPerBatch / 2));
  for (Track& track : set.tracks) track.kind = TrackKind::Declared, track.shares.clear();
  EXPECT_LE(encode(set).size(), static_cast<std::size_t>(kMaxMessageBytes));
  for (int i = 2; i < 200; ++i) set.tracks.push_back(support::random_track(rng, i, 1));
  set.tracks.erase(set.tracks.begin());
  EXPECT_THROW(encode(set), std::invalid_argument);
}

TEST(Encoding, ThrowsOnATrackWithoutAnAlphaForEachPiece) {
  Rng rng(8);
  TrackSet set;
  set.tracks.push_back(support::random_track(rng, 0, 3));
  set.tracks[0].alpha.pop_back();
  EXPECT_THROW(encode(set), std::invalid_argument);
}

TEST(Encoding, ThrowsOnSharesThatDoNotGoWithTheKindOfTrack) {
  Rng rng(9);
  TrackSet set;
  set.tracks.push_back(support::random_track(rng, 0, 3));
  set.tracks[0].kind = TrackKind::Declared;
  set.tracks[0].shares.assign(3, on_all_axes({1.0F, 1.0F, 1.0F, 1.0F}));
  EXPECT_THROW(encode(set), std::invalid_argument);
  set.tracks[0].kind = TrackKind::Estimated;
  EXPECT_NO_THROW(encode(set));
  set.tracks[0].shares.pop_back();
  EXPECT_THROW(encode(set), std::invalid_argument);
}

}  // namespace
}  // namespace tern
