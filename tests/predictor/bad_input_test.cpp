// Wrong input from sensors is counted and reported. The predictor survives it, and its intervals still cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "core/wire/message_limits.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "predictor/app/predictor_node.h"
#include "predictor/tracking/track_bound.h"
#include "runtime/virtual_runner.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::detection_of;
using testing::Path;

constexpr double kRate = 30.0, kNoise = 0.05;
constexpr Duration kLatency{50'000};

/// The detections of a frame at a time.
using Detector = std::function<std::vector<Detection>(double t)>;

/// A predictor, and all of its messages that receivers would accept.
class BadInput : public ::testing::Test {
 protected:
  void SetUp() override {
    runner_.start("tern-predictor", [&](Bus& bus) {
      auto node = std::make_unique<PredictorNode>(bus, PredictorConfig{});
      node_ = node.get();
      bus_ = &bus;
      return node;
    });
    runner_.observer().subscribe(channels::kPredictions, [this](const TrackSet& batch) {
      if (auto set = collector_.add(batch)) sets_.push_back(join_batches(std::move(*set)));
    });
    runner_.observer().subscribe(channels::kTrackBounds, [](const TrackBounds&) {});
    runner_.run(runner_.now() + Duration{1'000'000});
    begin_ = runner_.now();
  }
  [[nodiscard]] double now_s() const { return (runner_.now() - begin_).seconds(); }
  [[nodiscard]] UTime world(double t) const { return begin_ + Duration::from_seconds(t); }

  void frame(UTime at, std::vector<Detection> detections, std::int32_t sensor = 0) {
    ObservationSet set;
    set.at = at;
    set.sensor_id = sensor;
    set.detections = std::move(detections);
    runner_.observer().publish(channels::kObstacleObservations, set);
  }
  void watch(double seconds, const Detector& detector) {
    for (int k = 0; k < static_cast<int>(seconds * kRate); ++k) {
      runner_.run(runner_.now() + Duration::from_seconds(1.0 / kRate));
      const UTime at = runner_.now() - kLatency;
      frame(at, detector((at - begin_).seconds()));
    }
  }
  [[nodiscard]] std::int64_t late() const { return bus_->counters().at(channels::kObstacleObservations.name).late; }
  [[nodiscard]] std::int64_t refused(Rejection reason) const {
    return bus_->counters().at(channels::kObstacleObservations.name).rejected[static_cast<int>(reason)];
  }
  [[nodiscard]] bool says(const std::string& words) const {
    return node_->health().waiting_for.find(words) != std::string::npos;
  }
  /// Messages that every receiver would reject.
  [[nodiscard]] std::int64_t unheard() {
    std::int64_t sum = 0;
    for (const char* channel : {channels::kPredictions.name, channels::kTrackBounds.name}) {
      for (const auto n : runner_.observer().counters().at(channel).rejected) sum += n;
    }
    return sum;
  }

  /// The share of sets made in [from, to) in which at least one track covers the obstacle for the next `ahead` seconds.
  [[nodiscard]] double held(const Path& truth, double from, double to, double ahead) const {
    int all = 0, covered = 0;
    for (const TrackSet& set : sets_) {
      const double made = (set.made_at - begin_).seconds();
      if (made < from || made >= to) continue;
      ++all;
      covered += std::any_of(set.tracks.begin(), set.tracks.end(), [&](const Track& track) {
        return testing::covers(
            track, [&](double t) { return truth(t - (begin_ - UTime{}).seconds()); }, ahead);
      });
    }
    EXPECT_GT(all, 0);
    return static_cast<double>(covered) / all;
  }
  /// The most tracks of a set made in [from, to).
  [[nodiscard]] std::size_t most_tracks(double from, double to) const {
    std::size_t most = 0;
    for (const TrackSet& set : sets_) {
      const double made = (set.made_at - begin_).seconds();
      if (made >= from && made < to) most = std::max(most, set.tracks.size());
    }
    return most;
  }

  VirtualRunner runner_;
  Rng rng_{1};
  PredictorNode* node_ = nullptr;
  Bus* bus_ = nullptr;
  UTime begin_;
  BatchCollector<TrackSet> collector_;
  std::vector<TrackSet> sets_;
};

Path straight(const Vec3& p, const Vec3& v) {
  return [=](double t) -> Vec3 { return p + v * t; };
}

TEST_F(BadInput, DetectionsWithAbsurdVariances) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0)), other = straight(Vec3(0, 9, 1), Vec3(1, 0, 0));
  int k = 0;
  watch(4.0, [&](double t) {
    Detection absurd = detection_of(other(t), kNoise, rng_);
    constexpr std::array kVariances{1e12, 0.0, 1e6, 1e-300, 1e4};
    absurd.variance = Vec3::Constant(kVariances[static_cast<std::size_t>(k++) % kVariances.size()]);
    return std::vector{detection_of(walker(t), kNoise, rng_), absurd};
  });
  EXPECT_TRUE(says("detections with a standard deviation above"));
  EXPECT_EQ(unheard(), 0) << "one absurd detection must not make a set that the planner refuses";
  EXPECT_GE(held(walker, 0.5, 4.0, 1.0), 0.99) << "what is detected well is predicted as ever";
  for (const TrackSet& set : sets_) {
    for (const Track& track : set.tracks) {
      for (const Vec3& alpha : track.alpha) EXPECT_TRUE(alpha.allFinite() && alpha.minCoeff() >= 0.0);
    }
  }
}

TEST_F(BadInput, ADetectionAtNoPlaceCostsNoOther) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  watch(2.0, [&](double t) {
    return std::vector{detection_of(walker(t), kNoise, rng_), detection_of(Vec3(nan, nan, nan), kNoise, rng_)};
  });
  runner_.run(runner_.now() + Duration{100'000});
  EXPECT_GE(held(walker, 0.5, 2.0, 1.0), 0.99);
  EXPECT_EQ(refused(Rejection::Number), 60);
  EXPECT_EQ(most_tracks(0.5, 2.0), 1U);
}

TEST_F(BadInput, TimesThatJump) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  const auto see = [&](double t) { return std::vector{detection_of(walker(t), kNoise, rng_)}; };
  watch(2.0, see);
  // Ahead by more than clocks may differ: the set is rejected, and later sets in time are used.
  frame(runner_.now() + Duration{10'000'000}, see(now_s()));
  watch(1.0, see);
  EXPECT_EQ(refused(Rejection::Future), 1);
  EXPECT_EQ(late(), 0);
  EXPECT_GE(held(walker, 0.5, 3.0, 1.0), 0.99);
  // Back by more than the reorder window: counted as late, and made_at shows the age of the world.
  const std::size_t before = sets_.size();
  const UTime newest = sets_.back().made_at;
  for (int k = 0; k < 30; ++k) {
    runner_.run(runner_.now() + Duration::from_seconds(1.0 / kRate));
    frame(runner_.now() - Duration{5'000'000}, see(now_s() - 5.0));
  }
  runner_.run(runner_.now() + Duration{100'000});
  EXPECT_EQ(late(), 30);
  ASSERT_GT(sets_.size(), before);
  EXPECT_LE(sets_.back().made_at - newest, Duration{100'000}) << "nothing fresh is claimed";
  EXPECT_TRUE(says("silent for"));
  watch(1.0, see);
  EXPECT_GE(held(walker, now_s() - 0.5, now_s(), 1.0), 0.99);
}

TEST_F(BadInput, SixHundredDetectionsAFrame) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  // One detection is real. All others are false, at new places in each frame.
  watch(3.0, [&](double t) {
    std::vector<Detection> detections{detection_of(walker(t), kNoise, rng_)};
    while (detections.size() < 600) {
      const Vec3 nowhere(rng_.uniform(-40, 40), rng_.uniform(-40, 40), rng_.uniform(0, 4));
      detections.push_back(detection_of(nowhere, kNoise, rng_));
    }
    return detections;
  });
  EXPECT_EQ(unheard(), 0);
  EXPECT_EQ(late(), 0);
  EXPECT_GE(held(walker, 0.5, 3.0, 0.5), 0.99) << "it is not lost among them";
  EXPECT_GT(most_tracks(0.5, 3.0), 600U) << "what may be there is said";
}

TEST_F(BadInput, AFloodIsBoundedSaidAndCostsNoNearTrack) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  watch(1.5, [&](double t) {
    std::vector<Detection> detections{detection_of(walker(t), kNoise, rng_)};
    while (detections.size() < kMaxDetections) {  // leaves of a wood: at new places in each frame
      const Vec3 leaf(rng_.uniform(-40, 40), rng_.uniform(4.5, 40), rng_.uniform(0, 4));
      detections.push_back(detection_of(leaf, kNoise, rng_));
    }
    return detections;
  });
  EXPECT_TRUE(says("overloaded: ")) << node_->health().waiting_for;
  EXPECT_EQ(unheard(), 0);
  EXPECT_TRUE(std::ranges::any_of(sets_, [](const auto& set) { return set.left_out > 0; }));
  EXPECT_LE(most_tracks(0.0, 1.5), kMaxAnonymousTracks);
  EXPECT_GE(held(walker, 0.5, 1.5, 0.3), 0.99);
}

TEST_F(BadInput, ATrackThatReceiversWouldRefuseIsNotSentAndItsFieldIsNamed) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0)), leaving = straight(Vec3(1e6 - 2.0, 0, 1), Vec3(1, 0, 0));
  watch(1.9, [&](double t) {
    return std::vector{detection_of(walker(t), kNoise, rng_), detection_of(leaving(t), 0.0, rng_)};
  });
  EXPECT_EQ(unheard(), 0);
  EXPECT_TRUE(says("PREDICTIONS: not sent, since every receiver would refuse it: track "))
      << node_->health().waiting_for;
  EXPECT_TRUE(says("].c0.x is ") || says(".alpha.x is ")) << node_->health().waiting_for;
  EXPECT_GT(sets_.back().left_out, 0);
  EXPECT_GE(held(walker, 0.5, 1.9, 0.3), 0.99);
}

TEST_F(BadInput, TimesInSecondsAreSaidAndNotUsed) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  watch(0.5, [&](double t) { return std::vector{detection_of(walker(t), kNoise, rng_)}; });
  runner_.run(runner_.now() + Duration{20'000'000});
  frame(UTime{runner_.now().us / 1'000'000}, {detection_of(walker(0.0), kNoise, rng_)}, 2);
  runner_.run(runner_.now() + Duration{100'000});
  EXPECT_TRUE(says("sensor 2: measured 2")) << node_->health().waiting_for;
  EXPECT_EQ(unheard(), 0);
}

TEST_F(BadInput, IdsOfThePredictorsOwnTracks) {
  const Path left = straight(Vec3(0, 3, 1), Vec3(1, 0, 0)), right = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  // The left one has no id until the right one comes, which has the id that the left one's track was given.
  watch(1.0, [&](double t) { return std::vector{detection_of(left(t), kNoise, rng_)}; });
  watch(2.0, [&](double t) {
    return std::vector{detection_of(left(t), kNoise, rng_), detection_of(right(t), kNoise, rng_, kFirstOwnTrackId),
                       detection_of(right(t) - Vec3(0, 3, 0), kNoise, rng_, kFirstOwnTrackId + 1)};
  });
  EXPECT_EQ(unheard(), 0);
  EXPECT_TRUE(says("2 ids from 1000000000 on are not used")) << node_->health().waiting_for;
  EXPECT_FALSE(says("not sent"));
  EXPECT_GE(held(left, 1.5, 3.0, 0.5), 0.99);
  EXPECT_GE(held(right, 1.5, 3.0, 0.5), 0.99);
}

TEST_F(BadInput, AnIdOfASensorPerFrame) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  int id = 1;
  watch(1.0, [&](double t) {
    for (int k = 0; k < 10; ++k) frame(runner_.now() - kLatency, {}, id++);
    return std::vector{detection_of(walker(t), kNoise, rng_)};
  });
  runner_.run(runner_.now() + Duration{100'000});
  EXPECT_GE(late(), 300 - static_cast<int>(kMaxSensors)) << "the first sensors are used, the others counted";
  EXPECT_TRUE(says("not used, since 64 sensors send already")) << node_->health().waiting_for;
  EXPECT_GE(held(walker, 0.5, 1.0, 0.5), 0.99);
}

TEST_F(BadInput, IdsThatSwap) {
  for (const double apart : {0.6, 1.0, 3.0}) {
    const double from = now_s();
    const Path left = straight(Vec3(-from, apart, 1), Vec3(1, 0, 0)),
               right = straight(Vec3(-from, 0, 1), Vec3(1, 0, 0));
    watch(6.0, [&](double t) {
      const int swapped = static_cast<int>(std::floor((t - from) / 1.0)) % 2;  // once a second
      return std::vector{detection_of(left(t), kNoise, rng_, 7 + swapped),
                         detection_of(right(t), kNoise, rng_, 8 - swapped)};
    });
    EXPECT_GE(held(left, from + 0.5, now_s(), 0.5), 0.99) << apart;
    EXPECT_GE(held(right, from + 0.5, now_s(), 0.5), 0.99) << apart;
    watch(4.0, [](double) { return std::vector<Detection>{}; });
  }
  EXPECT_EQ(unheard(), 0);
}

TEST_F(BadInput, TwoSensorsThatDisagreeByHalfAMetre) {
  const Path walker = straight(Vec3(0, 0, 1), Vec3(1, 0, 0));
  for (int k = 0; k < 150; ++k) {
    runner_.run(runner_.now() + Duration::from_seconds(1.0 / kRate));
    const UTime at = runner_.now() - kLatency;
    const Vec3 p = walker((at - begin_).seconds());
    frame(at, {detection_of(p, kNoise, rng_)}, 1);
    frame(at + Duration{1'000}, {detection_of(p + Vec3(0.0, 0.5, 0.0), kNoise, rng_)}, 2);
  }
  // Neither sensor is known to be right, so each one's position must be covered.
  EXPECT_GE(held(walker, 0.5, 5.0, 1.0), 0.99);
  EXPECT_GE(held([&](double t) -> Vec3 { return walker(t) + Vec3(0.0, 0.5, 0.0); }, 0.5, 5.0, 1.0), 0.99);
  EXPECT_LE(most_tracks(0.5, 5.0), 3U);
  EXPECT_EQ(unheard(), 0);
}

TEST_F(BadInput, AMoverThatTeleports) {
  for (const std::int64_t id : {kNoTrackId, std::int64_t{7}}) {
    const double from = now_s();
    const Path here = straight(Vec3(-from, 0, 1), Vec3(1, 0, 0)), there = straight(Vec3(-from, 20, 1), Vec3(1, 0, 0));
    watch(2.0, [&](double t) { return std::vector{detection_of(here(t), kNoise, rng_, id)}; });
    const double jump = now_s() - kLatency.seconds();
    watch(1.0, [&](double t) { return std::vector{detection_of(there(t), kNoise, rng_, id)}; });
    EXPECT_GE(held(there, jump + 0.02, now_s(), 1.0), 0.99) << "from the first frame in which it is there";
    for (const TrackSet& set : sets_) {
      for (const Track& track : set.tracks) {
        const Vec3 v = track.motion.sample(track.motion.start).v;
        EXPECT_LT(v.norm(), 10.0) << "a teleport is no speed";
      }
    }
    watch(4.0, [](double) { return std::vector<Detection>{}; });
  }
  EXPECT_EQ(unheard(), 0);
}

}  // namespace
}  // namespace tern
