// Tracks by sightings, in scenes that a camera renders.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <vector>

#include "predictor/faces/looked_for.h"
#include "predictor/tracking/tracker.h"
#include "tests/predictor/rendered_sightings.h"
#include "tests/predictor/simulated_motion.h"

namespace tern {
namespace {

using testing::at_seconds;
using testing::RenderingSensor;
using Boxes = std::function<std::vector<Box>(double)>;

const Vec3 kEye(0, 0, 2);
constexpr double kRate = 30.0;

// A camera at kEye that looks along x watches the boxes over [from, to).
void watch(Tracker& tracker, RenderingSensor& sensor, double from, double to, const Boxes& boxes, double yaw = 0.0) {
  for (int k = 0; from + k / kRate < to - 1e-9; ++k) {
    const double t = from + k / kRate;
    ASSERT_EQ(tracker.update(sensor.frame(at_seconds(t), kEye, yaw, boxes(t)), kEye), UpdateOutcome::Used);
  }
}

// The published track whose box at its start contains a point, α left out; nullptr if there is none.
const Track* track_at(const std::vector<Track>& tracks, const Vec3& p, UTime at) {
  const auto found = std::ranges::find_if(tracks, [&](const Track& track) {
    return box_around(track.motion.sample(at).p, track.half_extents + Vec3::Constant(0.05)).contains(p);
  });
  return found == tracks.end() ? nullptr : &*found;
}

bool covers(const Track& track, const Box& box, UTime at) {
  const Vec3 reach = track.half_extents + track.alpha[track.motion.locate(at).index];
  return box_around(track.motion.sample(at).p, reach).contains(box);
}

TEST(SightedTracks, ABeamBehindAPassingPersonStaysAtRest) {
  const Box beam(Vec3(6, -2, 1.8), Vec3(6.4, 2, 2.2));
  const Boxes scene = [&](double t) {
    return std::vector{beam, box_around(Vec3(4, -3.0 + 1.5 * t, 2), Vec3(0.25, 0.25, 0.9))};
  };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  double fastest = 0.0;
  for (int k = 0; k < 120; ++k) {
    watch(tracker, camera, k / kRate, (k + 1) / kRate, scene);
    if (k < 30) continue;  // until its velocity is known
    for (const TrackedObject& object : tracker.sighted()) {
      const Box box = object.faces.completed(object.moving.lead().position());
      if (box.sizes().y() > 2.5) fastest = std::max(fastest, object.moving.lead().velocity().cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(fastest, 0.3);
  const UTime now = tracker.newest();
  const std::vector<Track> tracks = tracker.predict(now);
  const Track* track = track_at(tracks, Vec3(6.0, 1.9, 2.0), now);
  ASSERT_NE(track, nullptr);
  EXPECT_TRUE(covers(*track, beam, now + Duration{500'000}));
}

TEST(SightedTracks, AWallThatFillsThePictureHasNoVelocityAlongIt) {
  // It slides along y at 2 m/s, which nobody can see.
  const Boxes scene = [](double t) { return std::vector{Box(Vec3(2, -20 + 2 * t, -10), Vec3(2.5, 20 + 2 * t, 10))}; };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 1.0, scene);
  ASSERT_EQ(tracker.sighted().size(), 1u);
  const TrackedObject& wall = tracker.sighted().front();
  EXPECT_TRUE(wall.faces.has_position(0));
  EXPECT_FALSE(wall.faces.has_position(1));
  EXPECT_EQ(wall.moving.lead().velocity().y(), 0.0);
  EXPECT_LT(10.0 * wall.moving.lead().marginal(0).vv, wall.moving.lead().marginal(1).vv);
  EXPECT_FALSE(tracker.is_stationary(wall)) << "one axis tells too little";
}

TEST(SightedTracks, ACubeThatComesOutFromBehindAPillarIsTrackedByItsFaces) {
  const Box pillar(Vec3(4, -2, 0), Vec3(4.4, 0, 4));
  const auto cube = [](double t) { return box_around(Vec3(6.4, -2.4 + 1.5 * t, 2), Vec3::Constant(0.4)); };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 2.5, [&](double t) { return std::vector{pillar, cube(t)}; });
  const UTime now = tracker.newest();
  const std::vector<Track> tracks = tracker.predict(now);
  const double t = (now - UTime{}).seconds();
  const Track* track = track_at(tracks, cube(t).center() - Vec3(0.35, 0, 0), now);
  ASSERT_NE(track, nullptr);
  const Box predicted = box_around(track->motion.sample(now).p, track->half_extents);
  EXPECT_NEAR(predicted.min().x(), 6.0, 0.1);
  EXPECT_NEAR(track->motion.sample(now).v.y(), 1.5, 0.4);
  EXPECT_TRUE(covers(*track, cube(t + 0.5), now + Duration{500'000}));
}

TEST(SightedTracks, DieWhenLookedForAndNotFound) {
  const Box box = box_around(Vec3(5, 0, 2), Vec3::Constant(0.4));
  const Box background(Vec3(9, -20, -10), Vec3(9.5, 20, 10));
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 1.0, [&](double) { return std::vector{box, background}; });
  const auto is_known = [&] {
    return track_at(tracker.predict(tracker.newest()), box.center(), tracker.newest()) != nullptr;
  };
  ASSERT_TRUE(is_known());
  watch(tracker, camera, 1.0, 1.0 + (kMissesToDelete + 1) / kRate, [&](double) { return std::vector{background}; });
  EXPECT_FALSE(is_known());
}

TEST(SightedTracks, CoastWithGrowingAlphaWhileHidden) {
  const Box hidden = box_around(Vec3(6, 0, 2), Vec3::Constant(0.4));
  const Box curtain(Vec3(3, -3, 0), Vec3(3.2, 3, 4));
  TrackerConfig config;
  config.resting_after = Duration::from_seconds(1e6);  // as a mover
  Tracker tracker{config};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 1.0, [&](double) { return std::vector{hidden}; });
  const auto alpha = [&] {
    const std::vector<Track> tracks = tracker.predict(tracker.newest());
    const Track* track = track_at(tracks, hidden.center(), tracker.newest());
    return track == nullptr ? -1.0 : track->alpha.front().maxCoeff();
  };
  const double seen = alpha();
  watch(tracker, camera, 1.0, 1.25, [&](double) { return std::vector{hidden, curtain}; });
  const double later = alpha();
  EXPECT_GT(seen, 0.0);
  EXPECT_GT(later, seen);
  watch(tracker, camera, 1.25, 1.0 + kSightingCoast.seconds() + 0.2, [&](double) {
    return std::vector{hidden, curtain};
  });
  const auto is_there = [&](const TrackedObject& object) {
    const Box box = object.faces.completed(object.moving.lead().position());
    return box.contains(hidden.center()) && box.sizes().maxCoeff() < 2.0;  // not the curtain
  };
  EXPECT_TRUE(std::ranges::none_of(tracker.sighted(), is_there)) << "a mover is not kept for ever";
}

TEST(SightedTracks, WhatRestsIsRememberedBehindTheCamera) {
  const Box pillar(Vec3(5, -0.2, 0), Vec3(5.4, 0.2, 4));
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  const Boxes scene = [&](double) { return std::vector{pillar}; };
  watch(tracker, camera, 0.0, 3.0, scene);
  watch(tracker, camera, 3.0, 8.0, scene, std::numbers::pi);  // it looks away
  EXPECT_TRUE(std::ranges::any_of(tracker.sighted(), [&](const TrackedObject& object) {
    return tracker.is_stationary(object) && object.faces.completed(object.moving.lead().position()).intersects(pillar);
  }));
}

TEST(SightedTracks, ABeamWhoseEndIsHiddenIsPublishedWhole) {
  const Box beam(Vec3(6, -2, 1.8), Vec3(6.4, 1.2, 2.2)), pillar(Vec3(4, 0.4, 0), Vec3(4.4, 1.0, 4));
  const Boxes scene = [&](double) { return std::vector{beam, pillar}; };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 2.0, scene);
  const UTime now = tracker.newest();
  const std::vector<Track> tracks = tracker.predict(now);
  const Track* track = track_at(tracks, Vec3(6.0, -1.8, 2.0), now);
  ASSERT_NE(track, nullptr);
  EXPECT_TRUE(covers(*track, beam, now + Duration{500'000}));
  EXPECT_FALSE(covers(*track, Box(beam.min(), beam.max() + Vec3(0, 1.5, 0)), now)) << "beyond the pillar it is empty";
}

TEST(SightedTracks, ASlowMoverIsNotAtRest) {
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  const auto cube = [](double t) { return box_around(Vec3(7, -0.5 + 0.25 * t, 2), Vec3::Constant(0.4)); };
  for (int k = 0; k < 60; ++k) {
    watch(tracker, camera, k / kRate, (k + 1) / kRate, [&](double t) { return std::vector{cube(t)}; });
    ASSERT_EQ(tracker.sighted().size(), 1u);
    ASSERT_FALSE(tracker.is_stationary(tracker.sighted().front())) << "after " << k / kRate << " s";
  }
}

// Without an end on an axis, a sighting does not tell the place along it.
TEST(SightedTracks, AnAxisWithoutEndsIsPredictedAsLongUnseen) {
  const auto frame = [](double t, bool has_ends) {
    SightingSet set;
    set.at = at_seconds(t);
    set.view.sensor_position = kEye;
    Sighting cube;
    const Vec3 centre(6, t, 2);
    cube.lower = centre - Vec3::Constant(0.4);
    cube.upper = centre + Vec3::Constant(0.4);
    cube.lower_sigma = cube.upper_sigma = Vec3::Constant(0.01);
    cube.bounds.fill(BoundSight::Whole);
    cube.points = 100;
    if (!has_ends) cube.bounds[2] = cube.bounds[3] = BoundSight::Occluded;
    set.sightings = {cube};
    return set;
  };
  Tracker seen_in_part{TrackerConfig{}}, unseen{TrackerConfig{}};
  for (int k = 0; k < 75; ++k) {
    const double t = k / kRate;
    seen_in_part.update(frame(t, k < 60), kEye);
    if (k < 60) unseen.update(frame(t, true), kEye);
  }
  const UTime now = seen_in_part.newest();
  const std::vector<Track> part = seen_in_part.predict(now), none = unseen.predict(now);
  ASSERT_EQ(part.size(), 1u);
  ASSERT_EQ(none.size(), 1u);
  const std::size_t later = part[0].motion.locate(now + Duration{500'000}).index;
  EXPECT_NEAR(part[0].alpha[later].y(), none[0].alpha[later].y(), 0.15 * none[0].alpha[later].y());
  EXPECT_LT(part[0].alpha[later].x(), 0.8 * none[0].alpha[later].x()) << "its place along x is seen";
}

// Cubes of 0.8 m, seen whole by a sensor at kEye.
SightingSet cubes_frame(double t, const std::vector<Vec3>& centres) {
  SightingSet set;
  set.at = at_seconds(t);
  set.view.sensor_position = kEye;
  for (const Vec3& centre : centres) {
    Sighting cube;
    cube.lower = centre - Vec3::Constant(0.4);
    cube.upper = centre + Vec3::Constant(0.4);
    cube.lower_sigma = cube.upper_sigma = Vec3::Constant(0.01);
    cube.bounds.fill(BoundSight::Whole);
    cube.points = 100;
    set.sightings.push_back(cube);
  }
  return set;
}

TEST(SightedTracks, AMoverOfWhichNoEndIsSeenCoasts) {
  const auto flies_past = [](double t) { return Vec3(6, -2 + 2 * t, 2); };
  Tracker tracker{TrackerConfig{}};
  double t = 0.0;
  for (; t < 1.0; t += 1.0 / kRate) tracker.update(cubes_frame(t, {flies_past(t)}), kEye);
  ASSERT_EQ(tracker.sighted().size(), 1u);
  const UTime last = tracker.newest();
  // From now on something hides all ends. It may be another obstacle that is seen.
  const auto hidden = [&](double at) {
    SightingSet set = cubes_frame(at, {flies_past(at)});
    set.sightings[0].bounds.fill(BoundSight::Occluded);
    set.sightings[0].lower += Vec3::Constant(0.1);
    set.sightings[0].upper -= Vec3::Constant(0.1);
    return set;
  };
  for (; t < 1.2; t += 1.0 / kRate) tracker.update(hidden(t), kEye);
  ASSERT_EQ(tracker.sighted().size(), 1u) << "the hidden part is explained by the track";
  EXPECT_EQ(tracker.sighted()[0].last_seen, last);
  for (; t < 1.5; t += 1.0 / kRate) tracker.update(hidden(t), kEye);
  EXPECT_GE(tracker.sighted().size(), 2u) << "what is seen for longer has a track of its own";
  for (; t < 1.0 + kSightingCoast.seconds(); t += 1.0 / kRate) tracker.update(hidden(t), kEye);
  EXPECT_TRUE(std::ranges::none_of(tracker.sighted(), [](const TrackedObject& o) { return o.id == kFirstOwnTrackId; }))
      << "it ends before the longest coast, once its place is uncertain";
}

TEST(SightedTracks, TwoThatMergeIntoOneSightingStartNoThird) {
  const Vec3 left(6, -0.45, 2), right(6, 0.45, 2);
  Tracker tracker{TrackerConfig{}};
  double t = 0.0;
  for (; t < 1.0; t += 1.0 / kRate) tracker.update(cubes_frame(t, {left, right}), kEye);
  ASSERT_EQ(tracker.sighted().size(), 2u);
  for (; t < 1.3; t += 1.0 / kRate) {
    SightingSet set = cubes_frame(t, {left});
    set.sightings[0].upper.y() = right.y() + 0.4;
    tracker.update(set, kEye);
  }
  EXPECT_EQ(tracker.sighted().size(), 2u);
}

TEST(SightedTracks, BesideATrackANewOneIsPublishedOnceConfirmed) {
  const Vec3 known(6, -0.45, 2), beside(6, 0.45, 2), apart(6, 3, 2);
  Tracker tracker{TrackerConfig{}};
  int frames = 0;
  const auto see = [&](const std::vector<Vec3>& cubes) { tracker.update(cubes_frame(frames++ / kRate, cubes), kEye); };
  const auto published = [&] { return tracker.predict(tracker.newest()).size(); };
  while (frames < 30) see({known});
  ASSERT_EQ(published(), 1u);
  see({known, beside});
  EXPECT_EQ(published(), 1u) << "a part of the known one, or of both, may look so for a frame or two";
  see({known, beside});
  EXPECT_EQ(published(), 1u);
  see({known, beside});
  EXPECT_EQ(published(), 2u);
  see({known, beside, apart});
  EXPECT_EQ(published(), 3u) << "nothing is near that could be mistaken for it";
}

// The scores of all pools up to 0.25 s.
double scores(const Calibration& calibration) {
  double sum = 0.0;
  for (const CalibratedClass& of : kCalibratedClasses) sum += calibration.evidence(of.of, 0);
  return sum;
}

TEST(SightedTracks, CoarseOnesAreCalibratedApart) {
  Tracker both{TrackerConfig{}}, clear_alone{TrackerConfig{}};
  for (double t = 0.0; t < 3.0; t += 1.0 / kRate) {
    const Vec3 clear(6, -4 + 2 * t, 2), coarse = clear + Vec3(5, 0, 0);
    clear_alone.update(cubes_frame(t, {clear}), kEye);
    SightingSet set = cubes_frame(t, {clear, coarse});
    set.sightings[1].points = kCoarsePoints - 1;
    both.update(set, kEye);
  }
  EXPECT_GT(scores(both.scorer().calibration(true)), 0.0);
  EXPECT_EQ(scores(clear_alone.scorer().calibration(true)), 0.0);
  EXPECT_EQ(scores(both.scorer().calibration(false)), scores(clear_alone.scorer().calibration(false)));
}

// A wall of 5 m of which the ends along y are hidden. It is seen between two values of y.
SightingSet wall_frame(double t, double from, double to) {
  SightingSet set;
  set.at = at_seconds(t);
  set.view.sensor_position = kEye;
  Sighting wall;
  wall.lower = Vec3(6.0, from, 1);
  wall.upper = Vec3(6.4, to, 3);
  wall.lower_sigma = wall.upper_sigma = Vec3::Constant(0.01);
  wall.bounds.fill(BoundSight::Whole);
  wall.bounds[2] = wall.bounds[3] = BoundSight::Occluded;
  wall.points = 100;
  set.sightings = {wall};
  return set;
}

TEST(SightedTracks, WhatWasSeenOfARestingObstacleIsKept) {
  Tracker tracker{TrackerConfig{}};
  for (int k = 0; k < 60; ++k) tracker.update(wall_frame(k / kRate, 0.0, 5.0), kEye);
  tracker.update(wall_frame(60 / kRate, 2.25, 2.75), kEye);  // somebody steps before it
  ASSERT_EQ(tracker.sighted().size(), 1u);
  const TrackedObject& wall = tracker.sighted().front();
  EXPECT_TRUE(tracker.is_stationary(wall));
  const Box box = wall.faces.completed(wall.moving.lead().position());
  EXPECT_LE(box.min().y(), 1e-6);
  EXPECT_GE(box.max().y(), 5.0 - 1e-6);
}

TEST(SightedTracks, WhatRestsIsRememberedAsLongAsStated) {
  const TrackerConfig config;
  Tracker tracker{config};
  for (int k = 0; k < 60; ++k) tracker.update(wall_frame(k / kRate, 0.0, 5.0), kEye);
  const UTime last = tracker.newest();
  const auto look_away = [&](double unseen) {
    SightingSet nothing = wall_frame(0.0, 0.0, 5.0);
    nothing.at = last + Duration::from_seconds(unseen);
    nothing.sightings.clear();
    tracker.update(nothing, kEye);
  };
  const double most = config.remember_rest.seconds();
  for (double unseen = 0.1; unseen < most; unseen += 0.1) {
    look_away(unseen);
    ASSERT_EQ(tracker.sighted().size(), 1u) << "after " << unseen << " s";
    ASSERT_TRUE(tracker.is_stationary(tracker.sighted().front())) << "after " << unseen << " s";
  }
  look_away(most + 0.1);
  EXPECT_TRUE(tracker.sighted().empty());
}

TEST(SightedTracks, AStepOfNineTenthsIsAStart) {
  const auto cube = [](double t) {
    return box_around(Vec3(5, -0.5 + 0.9 * std::clamp(t - 2.0, 0.0, 1.0), 2), Vec3::Constant(0.4));
  };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  watch(tracker, camera, 0.0, 5.0, [&](double t) { return std::vector{cube(t)}; });
  ASSERT_EQ(tracker.sighted().size(), 1u);
  EXPECT_TRUE(tracker.is_stationary(tracker.sighted().front()));
  EXPECT_EQ(tracker.rest().starts, 1);
}

TEST(SightedTracks, WhatRestedMayBeginToMove) {
  const auto box = [](double t) { return box_around(Vec3(5, std::max(0.0, 1.5 * (t - 2.0)), 2), Vec3::Constant(0.4)); };
  Tracker tracker{TrackerConfig{}};
  RenderingSensor camera = RenderingSensor::camera();
  const Boxes scene = [&](double t) { return std::vector{box(t)}; };
  watch(tracker, camera, 0.0, 2.0, scene);
  ASSERT_EQ(tracker.sighted().size(), 1u);
  EXPECT_TRUE(tracker.is_stationary(tracker.sighted().front()));
  watch(tracker, camera, 2.0, 3.0, scene);
  ASSERT_EQ(tracker.sighted().size(), 1u);
  EXPECT_FALSE(tracker.is_stationary(tracker.sighted().front()));
  EXPECT_NEAR(tracker.sighted().front().moving.lead().velocity().y(), 1.5, 0.4);
}

TEST(SightedTracks, DoNotDependOnTheOrderInWhichSensorsReport) {
  const Boxes scene = [](double t) {
    return std::vector{box_around(Vec3(5, -1 + t, 2), Vec3::Constant(0.4)), Box(Vec3(4, 1, 0), Vec3(4.4, 1.4, 4))};
  };
  RenderingSensor camera = RenderingSensor::camera(), lidar = RenderingSensor::lidar();
  std::vector<SightingSet> frames;
  for (int k = 0; k < 30; ++k) {
    const double t = k / kRate;
    frames.push_back(camera.frame(at_seconds(t), kEye, 0.0, scene(t)));
    if (k % 3 == 0) frames.push_back(lidar.frame(at_seconds(t), kEye, 0.0, scene(t)));
  }
  Tracker in_order{TrackerConfig{}}, late{TrackerConfig{}};
  for (const SightingSet& frame : frames) in_order.update(frame, kEye);
  // The lidar is 100 ms late: its frame at t comes after the camera's at t + 0.1.
  std::ranges::stable_sort(frames, {}, [](const SightingSet& frame) {
    return frame.at + (frame.sensor_id == 1 ? Duration{110'000} : Duration{});
  });
  for (const SightingSet& frame : frames) late.update(frame, kEye);
  const std::vector<Track> a = in_order.predict(at_seconds(1.2)), b = late.predict(at_seconds(1.2));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].id, b[k].id);
    EXPECT_EQ(a[k].half_extents, b[k].half_extents);
    for (std::size_t piece = 0; piece < a[k].alpha.size(); ++piece) EXPECT_EQ(a[k].alpha[piece], b[k].alpha[piece]);
  }
}

// A sensor that detects whole boxes is used as before: another one's sightings change none of its tracks.
TEST(SightedTracks, LeaveTracksByDetectionsAlone) {
  Rng rng(7);
  RenderingSensor camera = RenderingSensor::camera(9);
  Tracker alone{TrackerConfig{}}, beside{TrackerConfig{}};
  for (int k = 0; k < 40; ++k) {
    const double t = k / kRate;
    ObservationSet set = testing::observations_at(t, {testing::detection_of(Vec3(8 + t, 0, 1), 0.05, rng)});
    alone.update(set);
    beside.update(set);
    beside.update(
        camera.frame(at_seconds(t + 0.01), kEye, std::numbers::pi, {box_around(Vec3(-5, 0, 2), Vec3::Ones())}), kEye);
  }
  ASSERT_EQ(alone.objects().size(), beside.objects().size());
  const TrackedObject &a = alone.objects().front(), &b = beside.objects().front();
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.half_extents, b.half_extents);
  EXPECT_EQ(beside.sighted().size(), 1u);
}

// A camera at 30 Hz sees past a pole that a lidar at 10 Hz sees until `lidar_until`.
class APoleThatOnlyALidarSees : public ::testing::Test {
 protected:
  void watch(double from, double to, double lidar_until) {
    for (int k = 0; from + k / kRate < to - 1e-9; ++k) {
      const double t = from + k / kRate;
      if (k % 3 == 0 && t < lidar_until) tracker_.update(lidar_.frame(at_seconds(t), kEye, 0.0, {pole_, wall_}), kEye);
      tracker_.update(camera_.frame(at_seconds(t + 0.01), kEye, 0.0, {wall_}), kEye);
    }
  }
  [[nodiscard]] bool is_known() const {
    return track_at(tracker_.predict(tracker_.newest()), pole_.center(), tracker_.newest()) != nullptr;
  }

  const Box pole_{Vec3(5, -0.2, 0), Vec3(5.4, 0.2, 4)}, wall_{Vec3(9, -20, -10), Vec3(9.5, 20, 10)};
  Tracker tracker_{TrackerConfig{}};
  RenderingSensor camera_ = RenderingSensor::camera(), lidar_ = RenderingSensor::lidar();
};

TEST_F(APoleThatOnlyALidarSees, StaysWhileTheCameraSeesPastIt) {
  for (double t = 0.0; t < 3.0; t += 0.1) {
    watch(t, t + 0.1, 3.0);
    ASSERT_TRUE(is_known()) << "after " << t + 0.1 << " s";
  }
}

TEST_F(APoleThatOnlyALidarSees, EndsSoonAfterTheLidarsLastFrame) {
  watch(0.0, 3.0, 2.0);
  EXPECT_FALSE(is_known());
}

TEST(LookedFor, IsThroughOnlyIfMostOfWhatIsInViewIsSeenThrough) {
  RenderingSensor camera = RenderingSensor::camera();
  const Box box = box_around(Vec3(5, 0, 2), Vec3::Constant(0.4));
  const auto look = [&](const std::vector<Box>& scene, const Box& at) {
    return is_looked_through(camera.frame(UTime{}, kEye, 0.0, scene).view, at);
  };
  EXPECT_TRUE(look({}, box));
  EXPECT_FALSE(look({box}, box)) << "it is there";
  EXPECT_FALSE(look({Box(Vec3(3, -1, 0), Vec3(3.1, 1, 4))}, box)) << "it is hidden";
  EXPECT_FALSE(look({}, box_around(Vec3(-5, 0, 2), Vec3::Constant(0.4)))) << "it is behind the camera";
  EXPECT_FALSE(look({}, box_around(Vec3(12, 0, 2), Vec3::Constant(0.4)))) << "it is out of range";
  EXPECT_TRUE(look({Box(Vec3(3, 0.15, 0), Vec3(3.1, 3, 4))}, box)) << "a third is hidden";
}

}  // namespace
}  // namespace tern
