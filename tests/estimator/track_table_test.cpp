// Views of tracks: what slips is found between two frames, and not used again.
#include "estimator/filter/track_table.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/random.h"
#include "core/world/vehicle.h"

namespace tern {
namespace {

Eigen::Vector2d noise(Rng& random) {
  const double u = random.normal(), v = random.normal();
  return {u, v};
}

/// A filter at rest whose velocity is hardly known, as after a long time in the dark.
Msckf at_rest_in_the_dark() {
  NavVector deviation;
  deviation << Vec3::Constant(2e-3), Vec3::Constant(0.5), Vec3::Constant(0.3), Vec3::Constant(1e-4),
      Vec3::Constant(0.02);
  return {NavState{}, NavMatrix(deviation.cwiseAbs2().asDiagonal())};
}

struct Slips {
  int slips = 0;          ///< as the table says
  std::size_t views = 0;  ///< of track 2 that can be used
};

/// Adds frames of a camera that rests before points 6 m away; `shift` moves a track's coordinates (px) in a frame.
Slips slips_of(TrackTable& table, int frames, const std::function<double(std::int64_t id, int frame)>& shift) {
  Msckf filter = at_rest_in_the_dark();
  Rng random(3);
  const double px = 1.0 / 460.0;
  Slips out;
  for (int k = 1; k <= frames; ++k) {
    FeatureFrame frame;
    frame.q_BC = {0.5, -0.5, 0.5, -0.5};
    frame.baseline_m = 0.11;
    frame.sigma = px;
    for (std::int64_t id = 1; id <= 4; ++id) {
      StereoFeature feature;
      feature.id = id;
      feature.left = Eigen::Vector2d(0.1 * static_cast<double>(id), shift(id, k) * px) + px * noise(random);
      feature.right = feature.left - Eigen::Vector2d(0.11 / 6.0, 0.0) + px * noise(random);
      frame.features.push_back(feature);
    }
    filter.propagate({Vec3::Zero(), Vec3(0.0, 0.0, kGravity), 0.05}, {}, kGravity);
    filter.add_clone(k, UTime{50'000 * k});
    out.slips += table.add(frame, filter);
  }
  for (const UsableFeature& feature : table.take(filter.clones(), 0, frames, 30)) {
    if (feature.id == 2) out.views = feature.views.size();
  }
  return out;
}

TEST(TrackTable, RefusesATrackThatSlipsForAsLongAsItLasts) {
  TrackTable steady, slipping, turning;
  const Slips none = slips_of(steady, 11, [](auto, int) { return 0.0; });
  EXPECT_EQ(none.slips, 0);
  EXPECT_EQ(none.views, 11u);
  // Track 2 goes on 12 pixels off: it is found once. Its later views agree with each other, and are not used.
  const Slips one = slips_of(slipping, 11, [](auto id, int k) { return id == 2 && k > 5 ? 12.0 : 0.0; });
  EXPECT_EQ(one.slips, 1);
  EXPECT_EQ(one.views, 5u);
  // All tracks jump: the pose is wrong, not they. They begin anew.
  const Slips all = slips_of(turning, 16, [](auto, int k) { return k > 5 ? 12.0 : 0.0; });
  EXPECT_EQ(all.slips, 4);
  EXPECT_EQ(all.views, 0u);
}

}  // namespace
}  // namespace tern
