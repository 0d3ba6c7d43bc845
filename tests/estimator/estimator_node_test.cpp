// The node: messages in, odometry out; the same messages give the same bytes.
#include "estimator/app/estimator_node.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "messages/batching.h"
#include "messages/codec.h"
#include "runtime/virtual_runner.h"
#include "tests/support/vio_flight.h"

namespace tern {
namespace {

/// Sends a simulated flight as messages, and records ODOMETRY.
class NodeFlight {
 public:
  explicit NodeFlight(const EstimatorNodeConfig& config = {}) {
    node_ = &runner_.start("tern-estimator",
                           [&](Bus& bus) { return std::make_unique<EstimatorNode>(bus, config, path_.start); });
    runner_.observer().subscribe(channels::kOdometry, [this](const Odometry& odometry) {
      odometry_.push_back(odometry);
      Odometry plain = odometry;
      plain.header = {{1, 1}, UTime{1}};
      bytes_.push_back(encode(plain));
    });
  }

  void fly(double seconds, std::int32_t camera = 0, const std::vector<Track>& movers = {}) {
    path_.duration = seconds;
    support::VioWorld world;
    world.length = 40.0;
    const auto events = simulate(path_, landmarks_of(world, 1), {}, 1);
    const Duration shift = runner_.now() - events.front().sample.at + Duration{10'000};
    for (const support::VioEvent& event : events) {
      runner_.run(event.sample.at + shift);
      if (event.is_frame) {
        if (!movers.empty()) send_movers(movers);
        FeatureFrame frame = event.frame;
        frame.at = event.frame.at + shift;
        frame.sensor_id = camera;
        runner_.observer().publish(channels::kFeatureTracks, frame);
      } else {
        ImuBatch batch;
        batch.samples = {event.sample};
        batch.samples[0].at = event.sample.at + shift;
        runner_.observer().publish(channels::kImu, batch);
      }
      truth_ = event.truth;
    }
    runner_.run(runner_.now() + Duration{20'000});
  }

  VirtualRunner runner_;
  support::VioPath path_ = support::weaving();
  const Node* node_ = nullptr;
  std::vector<Odometry> odometry_;
  std::vector<Bytes> bytes_;
  NavState truth_;

 private:
  void send_movers(const std::vector<Track>& movers) {
    TrackSet set;
    set.batch.set = ++sets_;
    set.made_at = runner_.now();
    set.tracks = movers;
    runner_.observer().publish_paced(channels::kPredictions, split_batches(set));
  }
  std::int64_t sets_ = 0;
};

TEST(EstimatorNode, PublishesTheEstimateOfItsMessages) {
  NodeFlight flight;
  EXPECT_NE(flight.node_->health().waiting_for.find("IMU of sensor 0 (none came)"), std::string::npos);
  flight.fly(3.0);
  ASSERT_GT(flight.odometry_.size(), 60u);
  EXPECT_EQ(flight.odometry_.front().state, EstimatorState::Starting);
  const Odometry& last = flight.odometry_.back();
  EXPECT_EQ(last.state, EstimatorState::Tracking);
  const PointInW place = OdometryOffset{last.p_WO, last.yaw_WO, last.epoch}.to_W(PointInO{last.p_OB});
  EXPECT_LT((place.xyz - flight.truth_.p).norm(), 0.3);
  EXPECT_GT(last.tracks, 50);
  EXPECT_EQ(flight.node_->health().state, ProcessState::Ready);
  flight.runner_.run(flight.runner_.now() + Duration{1'000'000});
  EXPECT_NE(flight.node_->health().waiting_for.find("IMU of sensor 0 (silent for 1.0 s)"), std::string::npos);
}

TEST(EstimatorNode, SameMessagesGiveTheSameBytes) {
  NodeFlight a, b;
  a.fly(2.0);
  b.fly(2.0);
  EXPECT_EQ(a.bytes_, b.bytes_);
  EXPECT_GT(a.bytes_.size(), 40u);
}

TEST(EstimatorNode, IgnoresOtherCamerasAndSaysThatItsOwnIsSilent) {
  NodeFlight flight;
  flight.fly(1.0, 7);
  EXPECT_EQ(flight.odometry_.back().tracks, 0);
  EXPECT_EQ(flight.odometry_.back().state, EstimatorState::Blind);
  EXPECT_NE(flight.node_->health().waiting_for.find("FEATURE_TRACKS of sensor 0 (none came)"), std::string::npos);
}

TEST(EstimatorNode, DoesNotUseFeaturesOnPredictedMovers) {
  // A mover that may be anywhere ahead: no feature is left. The static one hides nothing.
  Track everywhere;
  everywhere.id = 3;
  everywhere.kind = TrackKind::Declared;
  everywhere.half_extents = Vec3::Constant(60.0);
  CubicPiece piece{Duration{60'000'000}, PowerCubic::Zero()};
  everywhere.motion.start = UTime{1'000'000};
  piece.coefficients.col(3) = Vec3(61.2, 0.0, 0.0);
  everywhere.motion.pieces = {piece};
  everywhere.alpha = {Vec3::Zero()};
  NodeFlight flight, plain;
  flight.fly(1.0, 0, {everywhere});
  EXPECT_EQ(flight.odometry_.back().tracks, 0);
  everywhere.kind = TrackKind::Static;
  plain.fly(1.0, 0, {everywhere});
  EXPECT_GT(plain.odometry_.back().tracks, 50);
}

}  // namespace
}  // namespace tern
