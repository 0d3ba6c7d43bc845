// Tracks in rendered images against the true projections.
#include "features/stereo_tracker.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "features/image_check.h"
#include "tests/support/rendered_flight.h"

namespace tern {
namespace {

using support::ImagePair;
using support::TrackJudge;

/// Half the size of EuRoC's images, so that a test is quick.
constexpr double kScale = 0.5;

KltConfig half_size() {
  KltConfig config;
  config.apart_px = 15.0;
  return config;
}

/// Follows a flight's images. @param see  nullptr: as the scene is
struct Followed {
  explicit Followed(const support::SceneRig& rig) : judge(rig), tracker(rig.rig(), half_size()) {}
  void fly(const support::SceneRig& rig, double seconds,
           const std::function<ImagePair(const support::VioEvent&)>& see = nullptr, double rest = 0.1) {
    support::VioPath path = support::circling(seconds);
    path.rest = rest;
    for (const auto& event : simulate(path, {}, {}, 1)) {
      if (!event.is_frame) continue;
      const ImagePair pair = see ? see(event) : rig.see(event.t, event.truth);
      frames.push_back(tracker.track(event.frame.at, pair.left, pair.right));
      judge.judge(event.t, event.truth, frames.back());
      ended += tracker.report().contradicted;
    }
  }
  TrackJudge judge;
  StereoTracker tracker;
  std::vector<FeatureFrame> frames;
  int ended = 0;
};

/// 95 % of the coordinates are nearer to the truth than the stated σ of one pixel; of normal errors 68 % would be.
/// @param outlier_per  at most one view in so many is an outlier
void expect_stated_sigma(const TrackJudge& judge, int outlier_per = 300) {
  ASSERT_GT(judge.left.size(), 1000u);
  EXPECT_LT(support::quantile(judge.left, 0.95), 1.0);
  EXPECT_LT(support::quantile(judge.right, 0.95), 1.2);
  EXPECT_LT(judge.outliers, judge.views / outlier_per);
}

TEST(StereoTracker, StatesItsErrorAndHasFewOutliers) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  Followed flight(rig);
  flight.fly(rig, 5.0);
  expect_stated_sigma(flight.judge);
  const int frames = static_cast<int>(flight.frames.size());
  EXPECT_GT(flight.judge.features, 130 * frames) << "of 150";
  EXPECT_GT(flight.judge.with_right, flight.judge.features * 95 / 100);
  EXPECT_GT(flight.judge.features, 8 * static_cast<int>(flight.judge.ages.size())) << "tracks are long";
  EXPECT_LT(flight.ended, frames) << "all surroundings rest";
}

TEST(StereoTracker, FollowsThroughFisheyeLenses) {
  const support::SceneRig rig(*support::fisheye_rig(kScale), support::hall_with_box());
  Followed flight(rig);
  flight.fly(rig, 4.0);
  expect_stated_sigma(flight.judge);
}

TEST(StereoTracker, EndsTracksOfATexturedMover) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box(true));
  Followed flight(rig);
  flight.fly(rig, 4.0, nullptr, 1.6);
  expect_stated_sigma(flight.judge, 100);
  EXPECT_GT(flight.ended, 500) << "the mover comes into view and then fills half of the image";
  EXPECT_LT(flight.judge.on_mover, flight.judge.features / 200) << "no track of it lasts three frames";
}

TEST(StereoTracker, GoesOnThroughBlur) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  Followed flight(rig);
  // An exposure of 10 ms about the middle: at 0.7 rad/s and 230 pixels a blur of 1.6 pixels, and more by the motion.
  flight.fly(rig, 2.5, [&](const support::VioEvent& event) {
    std::vector<NavState> states;
    for (const double share : {-1.0, 0.0, 1.0}) {
      NavState state = event.truth;
      const double h = 0.005 * share;
      state.p += h * state.v;
      state.R = Eigen::AngleAxisd(h * (event.t > 0.0 ? 2.5 / 3.5 : 0.0), Vec3::UnitZ()).toRotationMatrix() * state.R;
      states.push_back(state);
    }
    return rig.blurred(event.t, states);
  });
  expect_stated_sigma(flight.judge);
  EXPECT_GT(flight.judge.features, 100 * static_cast<int>(flight.frames.size()));
}

TEST(StereoTracker, MatchesCamerasOfDifferentExposure) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  Followed flight(rig);
  flight.fly(rig, 1.0, [&](const support::VioEvent& event) {
    support::Lighting dim;
    dim.exposure = 0.75;
    return ImagePair{rig.see(event.t, event.truth).left, rig.see(event.t, event.truth, dim).right};
  });
  EXPECT_GT(flight.judge.with_right, flight.judge.features * 9 / 10);
}

TEST(StereoTracker, IdsAscendAndNoneComesBack) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  Followed flight(rig);
  flight.fly(rig, 2.0);
  std::set<std::int64_t> before, ended;
  for (const FeatureFrame& frame : flight.frames) {
    std::set<std::int64_t> ids;
    std::int64_t last = 0;
    for (const StereoFeature& feature : frame.features) {
      EXPECT_GT(feature.id, last);
      EXPECT_FALSE(ended.contains(feature.id));
      ids.insert(last = feature.id);
    }
    for (const std::int64_t id : before) {
      if (!ids.contains(id)) ended.insert(id);
    }
    before = ids;
    EXPECT_LE(frame.features.size(), 150u);
  }
  EXPECT_GT(ended.size(), 20u);
}

TEST(StereoTracker, TracksBeginSpreadOverTheImage) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  StereoTracker tracker(rig.rig(), half_size(), 1000);
  const auto events = simulate(support::circling(0.1), {}, {}, 1);
  const ImagePair pair = rig.see(0.0, events.front().truth);
  const FeatureFrame frame = tracker.track(UTime{1}, pair.left, pair.right);
  ASSERT_EQ(frame.features.size(), 150u);
  EXPECT_EQ(frame.features.front().id, 1000);
  EXPECT_EQ(frame.at, UTime{1});
  EXPECT_DOUBLE_EQ(frame.sigma, 1.0 / rig.rig().focal());
  int quarters[4] = {};
  for (const StereoFeature& a : frame.features) {
    ++quarters[(a.left.x() > 0.0 ? 1 : 0) + (a.left.y() > 0.0 ? 2 : 0)];
    for (const StereoFeature& b : frame.features) {
      EXPECT_TRUE(a.id == b.id || (a.left - b.left).norm() * rig.rig().focal() > 14.0);
    }
  }
  for (const int quarter : quarters) EXPECT_GT(quarter, 15);
}

TEST(StereoTracker, NoiseAloneHasNoCorners) {
  support::Lighting bare;
  bare.contrast = 0.0;
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box());
  StereoTracker tracker(rig.rig(), half_size());
  const auto events = simulate(support::circling(0.1), {}, {}, 1);
  const ImagePair pair = rig.see(0.0, events.front().truth, bare);
  EXPECT_TRUE(tracker.track(UTime{1}, pair.left, pair.right).features.empty());
}

TEST(StereoTracker, EqualImagesGiveEqualFeatures) {
  const support::SceneRig rig(*support::euroc_like_rig(kScale), support::hall_with_box(true));
  Followed a(rig), b(rig);
  a.fly(rig, 0.5);
  b.fly(rig, 0.5);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t k = 0; k < a.frames.size(); ++k) {
    ASSERT_EQ(a.frames[k].features.size(), b.frames[k].features.size());
    for (std::size_t i = 0; i < a.frames[k].features.size(); ++i) {
      const StereoFeature &x = a.frames[k].features[i], &y = b.frames[k].features[i];
      EXPECT_TRUE(x.id == y.id && x.left == y.left && x.has_right == y.has_right &&
                  (!x.has_right || x.right == y.right));
    }
  }
}

}  // namespace
}  // namespace tern
