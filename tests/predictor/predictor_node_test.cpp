#include "predictor/app/predictor_node.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <set>
#include <string>

#include "core/base/random.h"
#include "core/world/pose_error_join.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "runtime/lcm_network.h"
#include "runtime/virtual_runner.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

Track mover(std::int64_t id, const Vec3& p, const Vec3& v, UTime start, int pieces = 8) {
  Track track;
  track.id = id;
  track.half_extents = Vec3::Constant(0.4);
  track.top_speed = 5.0;
  track.motion.start = start;
  for (int k = 0; k < pieces; ++k) {
    CubicPiece piece{Duration{625'000}, PowerCubic::Zero()};
    piece.coefficients.col(2) = v;
    piece.coefficients.col(3) = p + v * (0.625 * k);
    track.motion.pieces.push_back(piece);
    track.alpha.push_back(Vec3::Constant(0.004));
  }
  return track;
}

// A predictor; the test plays simulator and planner.
class PredictorNodeTest : public ::testing::Test {
 protected:
  void start(const PredictorConfig& config = {}) {
    runner_.start("tern-predictor", [&](Bus& bus) {
      auto node = std::make_unique<PredictorNode>(bus, config);
      node_ = node.get();
      bus_ = &bus;
      return node;
    });
    runner_.observer().subscribe(channels::kPredictions, [this](const TrackSet& batch) {
      ++batches_;
      largest_gap_ = std::max(largest_gap_, batch.batch.index == 0 ? Duration{} : runner_.now() - last_batch_);
      last_batch_ = runner_.now();
      if (auto set = collector_.add(batch)) sets_.push_back(join_batches(std::move(*set)));
    });
  }
  void run_for(double seconds) { runner_.run(runner_.now() + Duration::from_seconds(seconds)); }
  void declare(std::vector<Track> tracks) {
    TrackSet set;
    set.batch.set = ++declared_sets_;
    set.made_at = runner_.now();
    set.tracks = std::move(tracks);
    runner_.observer().publish_paced(channels::kDeclaredMotions, split_batches(set));
  }
  void observe(std::vector<Detection> detections, Duration age = Duration{50'000}, std::int32_t sensor = 0) {
    ObservationSet set;
    set.at = runner_.now() - age;
    set.sensor_id = sensor;
    set.detections = std::move(detections);
    runner_.observer().publish(channels::kObstacleObservations, set);
  }
  // Frames of a stationary obstacle at 30 Hz.
  void watch_pillar(double seconds) {
    for (int k = 0; k < static_cast<int>(seconds * 30); ++k) {
      observe({testing::detection_of(Vec3(3, 0, 1), 0.02, rng_)});
      run_for(1.0 / 30);
    }
  }
  [[nodiscard]] std::int64_t late(const char* channel) const { return bus_->counters().at(channel).late; }
  [[nodiscard]] std::int64_t refused(const char* channel, Rejection reason) const {
    return bus_->counters().at(channel).rejected[static_cast<int>(reason)];
  }
  [[nodiscard]] bool says(const std::string& words) const {
    return node_->health().waiting_for.find(words) != std::string::npos;
  }
  void say_vehicle_is_at(const Vec3& p) {
    UavState state;
    state.at = runner_.now();
    state.motion.p = p;
    runner_.observer().publish(channels::kUavState, state);
  }

  VirtualRunner runner_;
  Rng rng_{1};
  PredictorNode* node_ = nullptr;
  Bus* bus_ = nullptr;
  std::int64_t declared_sets_ = 0;
  BatchCollector<TrackSet> collector_;
  std::vector<TrackSet> sets_;
  int batches_ = 0;
  UTime last_batch_;
  Duration largest_gap_;
};

TEST_F(PredictorNodeTest, WaitsAndNamesTheReasonUntilItHasAnInput) {
  start();
  run_for(2.0);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_EQ(node_->health().waiting_for, "obstacle observations or declared motions");
  EXPECT_EQ(batches_, 0);
}

TEST_F(PredictorNodeTest, AWorldWithoutObstaclesIsAnEmptySet) {
  start();
  declare({});
  run_for(0.15);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  ASSERT_FALSE(sets_.empty());
  EXPECT_TRUE(sets_.back().tracks.empty());
  EXPECT_EQ(sets_.back().confidence, 1.0);
}

TEST_F(PredictorNodeTest, AnEmptyObservationMakesItReady) {
  start();
  observe({});
  run_for(0.1);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  ASSERT_FALSE(sets_.empty());
  EXPECT_EQ(sets_.front().made_at, UTime{1'000'000 - 50'000});
}

TEST_F(PredictorNodeTest, PublishesTwentySetsPerSecond) {
  start();
  declare({mover(1, Vec3::Zero(), Vec3(1, 0, 0), runner_.now())});
  run_for(5.0);
  EXPECT_NEAR(static_cast<double>(sets_.size()), 100.0, 1.0);
  EXPECT_EQ(collector_.incomplete(), 0);
}

TEST_F(PredictorNodeTest, PassesDeclaredMotionsOn) {
  start();
  const Track track = mover(4, Vec3(1, 2, 3), Vec3(1, -1, 0.5), runner_.now());
  declare({track});
  run_for(1.0);
  ASSERT_FALSE(sets_.empty());
  const Track& got = sets_.back().tracks.at(0);
  EXPECT_EQ(got.id, 4);
  EXPECT_EQ(got.kind, TrackKind::Declared);
  EXPECT_EQ(got.alpha.front(), track.alpha.front());
  const UTime later = runner_.now() + Duration{1'000'000};
  EXPECT_EQ(got.motion.sample(later).p, track.motion.sample(later).p);
}

TEST_F(PredictorNodeTest, SendsThePoseErrorBeforeEachSetOnceThereIsAnEstimate) {
  start();
  std::vector<std::int64_t> sets_at_error;
  PoseErrorJoin join;
  runner_.observer().subscribe(channels::kPoseError, [&](const PoseError& error) {
    sets_at_error.push_back(static_cast<std::int64_t>(sets_.size()));
    EXPECT_EQ(error.set, static_cast<std::int64_t>(sets_.size()) + 1) << "it comes before its set";
    EXPECT_NEAR(error.margin(Vec3(1, 0, 1)), 0.35, 1e-9);
    join.add(error);
  });
  declare({mover(1, Vec3(3, 0, 1), Vec3::Zero(), runner_.now())});
  run_for(0.2);
  EXPECT_TRUE(sets_at_error.empty());
  Odometry odometry;
  odometry.at = runner_.now();
  odometry.state = EstimatorState::Tracking;
  odometry.p_OB = Vec3(1, 0, 1);
  odometry.pose_covariance[0] = 0.01;
  runner_.observer().publish(channels::kOdometry, odometry);
  run_for(0.2);
  ASSERT_FALSE(sets_at_error.empty());
  ASSERT_TRUE(join.add_to(sets_.back()));
  EXPECT_TRUE(sets_.back().pose_error);
  EXPECT_EQ(sets_.back().confidence, PoseError::kConfidence);
}

TEST_F(PredictorNodeTest, GoesOnWithTheOldTimeWhenInputsStop) {
  start();
  declare({mover(1, Vec3::Zero(), Vec3(1, 0, 0), runner_.now())});
  const UTime declared_at = runner_.now();
  run_for(0.2);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  run_for(10.0);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_EQ(sets_.back().made_at, declared_at);
  EXPECT_GE(runner_.now() - sets_.back().header.utime, Duration{});
  EXPECT_LE(runner_.now() - sets_.back().header.utime, Duration{50'000});
  ASSERT_EQ(sets_.back().tracks.size(), 1u);
  EXPECT_GT(sets_.back().tracks[0].bounds(runner_.now(), runner_.now()).sizes().x(), 20.0);
}

TEST_F(PredictorNodeTest, EstimatesUndeclaredObstacles) {
  start();
  Rng rng(1);
  const UTime begin = runner_.now();
  const Track declared = mover(1, Vec3(5, 0, 1), Vec3(-1, 0, 0), begin, 16);
  for (int k = 0; k < 60; ++k) {
    if (k % 6 == 0) declare({declared});
    const UTime at = runner_.now() - Duration{50'000};
    const Vec3 other(0.0, 1.5 * (at - begin).seconds(), 1.0);
    observe({testing::detection_of(declared.motion.sample(at).p, 0.05, rng), testing::detection_of(other, 0.05, rng)});
    run_for(1.0 / 30);
  }
  const TrackSet& set = sets_.back();
  ASSERT_EQ(set.tracks.size(), 2u);
  EXPECT_EQ(set.confidence, 0.99);
  EXPECT_EQ(set.tracks[0].id, 1);
  EXPECT_EQ(set.tracks[0].kind, TrackKind::Declared);
  EXPECT_EQ(set.tracks[1].kind, TrackKind::Estimated);
  EXPECT_NEAR(set.tracks[1].motion.sample(runner_.now()).v.y(), 1.5, 0.3);
}

TEST_F(PredictorNodeTest, ReportsTwiceASecondTheRuleBehindEachWidth) {
  start();
  std::vector<TrackBounds> told;
  runner_.observer().subscribe(channels::kTrackBounds, [&](const TrackBounds& of) { told.push_back(of); });
  Rng rng(1);
  const UTime begin = runner_.now();
  for (int k = 0; k < 60; ++k) {
    declare({mover(1, Vec3(50, 0, 1), Vec3(-1, 0, 0), runner_.now())});
    const Vec3 p(0.0, 1.5 * (runner_.now() - Duration{50'000} - begin).seconds(), 1.0);
    observe({testing::detection_of(p, 0.05, rng)});
    run_for(1.0 / 30);
  }
  ASSERT_EQ(told.size(), 4u);
  const TrackBounds& of = told.back();
  EXPECT_EQ(of.confidence, 0.99);
  const auto set =
      std::ranges::find_if(sets_, [&](const TrackSet& s) { return s.tracks.back().motion.start == of.at; });
  ASSERT_NE(set, sets_.end());
  ASSERT_EQ(of.bounds.size(), 1u) << "what is declared needs no reason";
  const TrackBound& bound = of.bounds.front();
  const Track& track = set->tracks.back();
  EXPECT_EQ(bound.id, track.id);
  const auto piece = track.motion.locate(of.at + Duration::from_seconds(bound.ahead_s) - Duration{1}).index;
  EXPECT_EQ(bound.promised, track.alpha[piece].maxCoeff());
  EXPECT_EQ(bound.ruled_by, BoundRule::Prior) << "of a second and a half little is known";
}

TEST_F(PredictorNodeTest, ReportsNoBoundsForEstimatesOfAnOwner) {
  start();
  std::vector<TrackBounds> told;
  runner_.observer().subscribe(channels::kTrackBounds, [&](const TrackBounds& of) { told.push_back(of); });
  Track estimate = mover(1, Vec3(5, 0, 1), Vec3(-1, 0, 0), runner_.now());
  estimate.kind = TrackKind::Estimated;
  estimate.shares.assign(estimate.alpha.size(), on_all_axes({1.0F, 1.0F, 1.0F, 1.0F}));
  declare({estimate});
  run_for(1.0);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(told.back().bounds.empty());
  ASSERT_EQ(sets_.back().tracks.size(), 1u);
}

TEST_F(PredictorNodeTest, EachModelUsesItsInputsOnly) {
  for (const PredictorModel model : {PredictorModel::Declared, PredictorModel::Detections}) {
    VirtualRunner runner;
    PredictorConfig config;
    config.model = model;
    runner.start("tern-predictor", [&](Bus& bus) { return std::make_unique<PredictorNode>(bus, config); });
    std::set<TrackKind> kinds;
    runner.observer().subscribe(channels::kPredictions, [&](const TrackSet& batch) {
      for (const Track& track : batch.tracks) kinds.insert(track.kind);
    });
    Rng rng(2);
    for (int k = 0; k < 30; ++k) {
      TrackSet declared;
      declared.batch.set = k + 1;
      declared.made_at = runner.now();
      declared.tracks = {mover(1, Vec3::Zero(), Vec3::Zero(), runner.now())};
      runner.observer().publish(channels::kDeclaredMotions, declared);
      ObservationSet observed;
      observed.at = runner.now();
      observed.detections = {testing::detection_of(Vec3(9, 9, 9), 0.05, rng)};
      runner.observer().publish(channels::kObstacleObservations, observed);
      runner.run(runner.now() + Duration{33'333});
    }
    EXPECT_EQ(kinds,
              std::set<TrackKind>{model == PredictorModel::Declared ? TrackKind::Declared : TrackKind::Estimated});
  }
}

TEST_F(PredictorNodeTest, ThreeHundredTracksAreCompleteSetsPaced) {
  start();
  for (int k = 0; k < 100; ++k) {
    std::vector<Track> tracks;
    for (int i = 0; i < 300; ++i) tracks.push_back(mover(i, Vec3(i, 0.2 * k, 1), Vec3(0, 1, 0), runner_.now()));
    declare(std::move(tracks));
    run_for(0.2);
  }
  EXPECT_NEAR(static_cast<double>(sets_.size()), 400.0, 1.0);
  EXPECT_EQ(collector_.incomplete(), 0);
  EXPECT_EQ(sets_.back().tracks.size(), 300u);
  EXPECT_EQ(sets_.back().left_out, 0);
  EXPECT_GE(batches_, 6 * 399);
  EXPECT_EQ(largest_gap_, kPacing);
}

TEST_F(PredictorNodeTest, MakesTracksCoarserRatherThanLeaveThemOut) {
  start();
  std::vector<Detection> detections;
  for (int k = 0; k < 10; ++k) {
    Rng rng(static_cast<std::uint64_t>(k) + 1);
    detections.clear();
    for (int i = 0; i < 400; ++i) detections.push_back(testing::detection_of(Vec3(20.0 * i, 0.0, 1.0), 0.02, rng, i));
    observe(detections, Duration{});
    run_for(0.033);
  }
  EXPECT_EQ(sets_.back().tracks.size(), 400u);
  EXPECT_EQ(sets_.back().left_out, 0);
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(PredictorNodeTest, LeavesOutTheFarthestAndCountsThem) {
  start();
  constexpr int kThings = 2400, kSensors = 4;
  const auto place = [](int i) { return Vec3(40.0 * (i / 2), 60.0 * (i % 2), 1.0); };
  const Vec3 vehicle(600.0, 0.0, 1.0);
  for (int k = 0; k < 5; ++k) {
    Rng rng(static_cast<std::uint64_t>(k) + 1);
    say_vehicle_is_at(vehicle);
    for (int sensor = 0; sensor < kSensors; ++sensor) {
      std::vector<Detection> detections;
      for (int i = sensor; i < kThings; i += kSensors)
        detections.push_back(testing::detection_of(place(i), 0.02, rng, i));
      observe(std::move(detections), Duration{}, sensor);
    }
    run_for(0.033);
  }
  run_for(0.05);
  const TrackSet& set = sets_.back();
  EXPECT_GT(set.left_out, 0);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_TRUE(says(std::to_string(set.left_out) + " of 2400 tracks do not fit")) << node_->health().waiting_for;
  ASSERT_EQ(set.tracks.size() + static_cast<std::size_t>(set.left_out), static_cast<std::size_t>(kThings));
  double farthest_in = 0.0, nearest_out = 1e9;
  std::set<std::int64_t> in;
  for (const Track& track : set.tracks) in.insert(track.id);
  for (int i = 0; i < kThings; ++i) {
    const double distance = (place(i) - vehicle).norm();
    (in.contains(i) ? farthest_in = std::max(farthest_in, distance) : nearest_out = std::min(nearest_out, distance));
  }
  EXPECT_LE(farthest_in, nearest_out + 2.0);
}

TEST_F(PredictorNodeTest, ReportsTracksThatOwnersLeftOut) {
  start();
  TrackSet set;
  set.batch.set = 1;
  set.made_at = runner_.now();
  set.left_out = 12;
  set.tracks = {mover(1, Vec3::Zero(), Vec3(1, 0, 0), runner_.now())};
  runner_.observer().publish_paced(channels::kDeclaredMotions, split_batches(set));
  run_for(0.15);
  ASSERT_FALSE(sets_.empty());
  EXPECT_EQ(sets_.back().left_out, 12);
  EXPECT_TRUE(says("12 declared motions are missing: their owner left them out")) << node_->health().waiting_for;
}

TEST_F(PredictorNodeTest, CountsObservationsThatComeTooLate) {
  start();
  observe({}, Duration{});
  run_for(0.1);
  observe({}, Duration{600'000});
  run_for(0.1);
  EXPECT_EQ(late(channels::kObstacleObservations.name), 1);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_EQ(sets_.back().made_at, UTime{1'000'000});
}

TEST_F(PredictorNodeTest, ASensorWhoseClockIsFarAheadChangesNothing) {
  start();
  watch_pillar(1.0);
  for (int k = 0; k < 3; ++k) observe({}, Duration{-60'000'000}, 7);
  watch_pillar(1.0);
  EXPECT_EQ(late(channels::kObstacleObservations.name), 0) << "of the first sensor's sets none is late";
  EXPECT_EQ(refused(channels::kObstacleObservations.name, Rejection::Future), 3);
  ASSERT_EQ(sets_.back().tracks.size(), 1u);
  EXPECT_LE(sets_.back().made_at, runner_.now());
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  EXPECT_EQ(bus_->sender_troubles(),
            "OBSTACLE_OBSERVATIONS: stamped 60.0 s ahead of this clock, refused: synchronize the clocks");
  watch_pillar(2.0);
  EXPECT_EQ(bus_->sender_troubles(), "") << "it is over";
  EXPECT_EQ(node_->health().waiting_for, "");
}

TEST_F(PredictorNodeTest, MotionsDeclaredInTheFutureDoNotMakeTheWorldYoung) {
  start();
  TrackSet set;
  set.batch.set = 1;
  set.made_at = runner_.now() + Duration{60'000'000};
  runner_.observer().publish(channels::kDeclaredMotions, set);
  run_for(0.1);
  EXPECT_EQ(refused(channels::kDeclaredMotions.name, Rejection::Future), 1);
  EXPECT_TRUE(sets_.empty());
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
}

TEST_F(PredictorNodeTest, TakesClocksThatAreATenthOfASecondAhead) {
  start();
  observe({}, Duration{-100'000});
  run_for(0.1);
  EXPECT_EQ(refused(channels::kObstacleObservations.name, Rejection::Future), 0);
  EXPECT_EQ(node_->health().state, ProcessState::Ready);
  observe({}, Duration{-100'001});
  run_for(0.1);
  EXPECT_EQ(refused(channels::kObstacleObservations.name, Rejection::Future), 1);
}

TEST_F(PredictorNodeTest, NamesTheSensorThatFellSilentBesideDeclaredMotions) {
  start();
  watch_pillar(1.0);
  for (int k = 0; k < 10; ++k) {
    declare({mover(1, Vec3(20, 0, 0), Vec3(1, 0, 0), runner_.now())});
    run_for(0.2);
  }
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_TRUE(says("obstacle observations of sensor 0 (silent for 2.0 s)")) << node_->health().waiting_for;
  EXPECT_FALSE(says("declared")) << node_->health().waiting_for;
  EXPECT_LE(runner_.now() - sets_.back().made_at, Duration{300'000}) << "made_at is the newest input's";
  watch_pillar(0.1);
  declare({});
  run_for(0.05);
  EXPECT_EQ(node_->health().state, ProcessState::Ready) << node_->health().waiting_for;
}

TEST_F(PredictorNodeTest, NamesTheSensorThatFellSilentBesideAnother) {
  start();
  for (const int age_us : {20, 10, 0}) observe({}, Duration{age_us}, 3);
  watch_pillar(1.0);
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_TRUE(says("obstacle observations of sensor 3 (silent for 1.0 s)")) << node_->health().waiting_for;
}

TEST_F(PredictorNodeTest, DoesNotMissAFalseSensorThatSentOnce) {
  start();
  observe({}, Duration{}, 3);
  watch_pillar(1.0);
  EXPECT_EQ(node_->health().state, ProcessState::Ready) << node_->health().waiting_for;
}

TEST_F(PredictorNodeTest, OldFramesThatKeepComingAreNotSilence) {
  start();
  for (int k = 0; k < 30; ++k) {
    observe({}, Duration{800'000});
    run_for(1.0 / 30);
  }
  EXPECT_EQ(node_->health().state, ProcessState::Waiting);
  EXPECT_FALSE(says("silent")) << node_->health().waiting_for;
}

TEST_F(PredictorNodeTest, AnySenderOfObservationsLeavesRoomInTheHeartbeat) {
  start();
  for (const int age_us : {20, 10, 0}) {
    for (std::int32_t sensor = 0; sensor < 1000; ++sensor) {
      observe({}, Duration{age_us}, sensor);
      observe({}, Duration{-60'000'000}, sensor);
    }
  }
  Heartbeat newest;
  runner_.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& heard) { newest = heard; });
  run_for(2.0);
  EXPECT_EQ(newest.state, ProcessState::Waiting);
  EXPECT_NE(newest.waiting_for.find("more"), std::string::npos) << newest.waiting_for;
}

TEST_F(PredictorNodeTest, CountsASetThatComesTwice) {
  start();
  observe({}, Duration{});
  observe({}, Duration{}, 1);
  run_for(0.1);
  EXPECT_EQ(late(channels::kObstacleObservations.name), 0);
  observe({}, Duration{100'000}, 1);
  run_for(0.1);
  EXPECT_EQ(late(channels::kObstacleObservations.name), 1);
  EXPECT_TRUE(says("sensor 1: two sets of one time")) << node_->health().waiting_for;
}

// A clock that the test moves, and that advances with each look: the time that a slow machine takes for a set.
class SlowClock final : public Clock {
 public:
  [[nodiscard]] UTime now() const override { return now_ = now_ + each_look_; }
  [[nodiscard]] UTime at_system_time(std::int64_t) const override { return now_; }
  void take(Duration each_look) { each_look_ = each_look; }
  void advance(Duration by) { now_ = now_ + by; }

 private:
  mutable UTime now_{10'000'000};
  Duration each_look_{};
};

class Backlog : public ::testing::Test {
 protected:
  Backlog() {
    for (int k = 0; k < 5; ++k) {
      ObservationSet set;
      set.at = clock_.now();
      clock_.advance(Duration{33'000});
      sensor_.publish(channels::kObstacleObservations, set);
    }
    drain(*lcm_, 100);
  }
  [[nodiscard]] std::int64_t late() const { return bus_.counters().at(channels::kObstacleObservations.name).late; }

  SlowClock clock_;
  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  Bus bus_{lcm_, clock_, 1}, sensor_{lcm_, clock_, 2};
  PredictorNode node_{bus_, {}};
};

TEST_F(Backlog, SetsThatWaitedTooLongAreSkippedForNewerOnes) {
  clock_.advance(kMaxWait + Duration{1'000});
  node_.step(clock_.now());
  EXPECT_EQ(late(), 4);
  EXPECT_NE(node_.health().waiting_for.find("overloaded, sets are skipped"), std::string::npos);
  EXPECT_EQ(node_.health().waiting_for.find("silent"), std::string::npos) << "the newest one was used";
  EXPECT_GE(node_.next_wakeup(), clock_.now()) << "none waits any longer";
}

TEST_F(Backlog, LargeSetsAreSentWholeHoweverLongAStepTakes) {
  TrackSet declared;
  declared.batch.set = 1;
  declared.made_at = clock_.now();
  for (int k = 0; k < 400; ++k) declared.tracks.push_back(mover(k, Vec3(k, 0, 1), Vec3::Zero(), clock_.now()));
  sensor_.publish_paced(channels::kDeclaredMotions, split_batches(declared));
  int whole = 0;
  BatchCollector<TrackSet> collector;
  Bus planner(lcm_, clock_, 3);
  planner.subscribe(channels::kPredictions, [&](const TrackSet& batch) { whole += collector.add(batch) ? 1 : 0; });
  for (int k = 0; k < 100; ++k) {
    ObservationSet set;
    set.at = clock_.now();
    sensor_.publish(channels::kObstacleObservations, set);
    drain(*lcm_, 100);
    clock_.advance(Duration{80'000});  // the work of the step
    node_.step(clock_.now());
    for (Bus* bus : {&bus_, &sensor_}) bus->send_due(clock_.now());
  }
  EXPECT_GT(whole, 10);
  EXPECT_EQ(bus_.unsent(), 0);
}

TEST_F(Backlog, HoldsABoundedNumberOfSets) {
  for (std::size_t k = 0; k < kMaxWaitingSets; ++k) {
    ObservationSet set;
    set.at = clock_.now();
    clock_.advance(Duration{1});
    sensor_.publish(channels::kObstacleObservations, set);
  }
  drain(*lcm_, 1000);
  EXPECT_EQ(late(), 5);
}

TEST_F(Backlog, AStepEndsAfterItsTimeAndTheRestFollows) {
  clock_.take(Duration{kMaxWorkPerStep.us / 3 + 1});  // a set looks at the clock three times
  node_.step(clock_.now());
  EXPECT_LE(node_.next_wakeup(), clock_.now()) << "sets still wait, but heartbeat and signals come first";
  clock_.take(Duration{});
  node_.step(clock_.now());
  EXPECT_EQ(late(), 0) << "all were used";
}

}  // namespace
}  // namespace tern
