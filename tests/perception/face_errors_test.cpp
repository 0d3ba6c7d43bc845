// The errors of measured bounds in the forest of SANDO, against the true boxes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core/base/random.h"
#include "perception/detector.h"
#include "simulator/worlds/world.h"
#include "tests/perception/scene.h"
#include "tests/support/effort.h"

namespace tern {
namespace {

using support::Scene;

/// Errors of one kind of bound, m, and in standard deviations.
struct Errors {
  std::vector<double> metres, sigmas;

  [[nodiscard]] static double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  }
};

/// Counts and errors of the sightings at 2–4, 4–6 and 6–10 m that belong to one box.
struct Ring {
  Errors faces, ends;
  int sightings = 0, merged = 0, measured = 0, wrong = 0;
};

struct Measured {
  std::array<Ring, 3> rings;

  void add(const Scene& scene, const Sighting& sighting) {
    const Vec3& eye = scene.picture.pose().position;
    const double distance = Box(sighting.lower, sighting.upper).exteriorDistance(eye);
    if (distance < 2.0 || distance >= 10.0) return;
    Ring& ring = rings[distance < 4.0 ? 0 : (distance < 6.0 ? 1 : 2)];
    int best = -1, most = 0, all = 0;
    for (const auto& [box, pixels] : scene.owners(sighting)) {
      all += pixels;
      if (pixels > most) {
        most = pixels;
        best = box;
      }
    }
    ++ring.sightings;
    if (most < 0.9 * all || most < 0.8 * sighting.points || best < 0) return void(++ring.merged);
    for (std::size_t b = 0; b < 6; ++b) add_bound(ring, sighting, b, scene.boxes[idx(best)]);
  }

  static void add_bound(Ring& ring, const Sighting& sighting, std::size_t b, const Box& box) {
    if (sighting.bounds[b] != BoundSight::Face && sighting.bounds[b] != BoundSight::Whole) return;
    const auto axis = static_cast<Eigen::Index>(b / 2);
    const bool low = b % 2 == 0;
    const double error =
        std::abs(low ? sighting.lower[axis] - box.min()[axis] : sighting.upper[axis] - box.max()[axis]);
    Errors& of = sighting.bounds[b] == BoundSight::Face ? ring.faces : ring.ends;
    const double sigma = low ? sighting.lower_sigma[axis] : sighting.upper_sigma[axis];
    of.metres.push_back(error);
    of.sigmas.push_back(error / sigma);
    ++ring.measured;
    if (error > std::max(0.3, 4.0 * sigma)) ++ring.wrong;
  }

  void print(const char* name) const {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const Ring& ring = rings[r];
      std::printf("%s %zu: %d sightings, %.1f %% of several boxes, %.2f %% wrong", name, r, ring.sightings,
                  100.0 * ring.merged / ring.sightings, 100.0 * ring.wrong / ring.measured);
      for (const Errors* of : {&ring.faces, &ring.ends}) {
        std::printf("; %zu: p50 %.3f p90 %.3f p99 %.3f m, p90 %.1f p99 %.1f σ", of->metres.size(),
                    Errors::quantile(of->metres, 0.5), Errors::quantile(of->metres, 0.9),
                    Errors::quantile(of->metres, 0.99), Errors::quantile(of->sigmas, 0.9),
                    Errors::quantile(of->sigmas, 0.99));
      }
      std::printf("\n");
    }
  }
};

/// Pictures along a flight at 5 m/s through the forest, over a ground.
Measured along_the_forest(const DepthSensor& sensor, std::uint64_t first_seed) {
  Measured measured;
  Scene scene(sensor);
  Detector detector;
  int frame = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + idx(support::at_effort(20)); ++seed) {
    Scenario scenario;
    scenario.seed = seed;
    scenario.world.generator = "sando_forest";
    scenario.world.count = 200;
    scenario.uav.start = Vec3(0, 0, 2);
    scenario.uav.goal = Vec3(105, 0, 2);
    const World world = make_world(scenario, "").value();
    Rng rng(seed);
    for (double x = 0.0; x < 95.0; x += 1.0, ++frame) {
      std::vector<Box> boxes;
      for (const TrueObstacle& o : true_obstacles(world, x / 5.0))
        boxes.push_back(box_around(o.position, o.half_extents));
      scene.render(looking(Vec3(x, rng.uniform(-3, 3), rng.uniform(1, 3)), rng.uniform(-0.5, 0.5)), boxes, 0.0, frame);
      for (const Sighting& s : detector.detect(scene.picture, {0.0, {}})) measured.add(scene, s);
    }
  }
  return measured;
}

/// The aims of a camera with white noise: 3 cm at 4–6 m, 15 cm at 6–10 m.
TEST(FaceErrors, StayBelowThreeCentimetresAtFourToSixMetres) {
  const Measured measured = along_the_forest(support::camera(), 101);
  measured.print("camera");
  EXPECT_LE(Errors::quantile(measured.rings[0].faces.metres, 0.99), 0.03);
  EXPECT_LE(Errors::quantile(measured.rings[1].faces.metres, 0.99), 0.03);
  EXPECT_LE(Errors::quantile(measured.rings[2].faces.metres, 0.99), 0.15);
  for (const Ring& ring : measured.rings) {
    EXPECT_LE(ring.wrong, 0.01 * ring.measured);
    EXPECT_LE(Errors::quantile(ring.faces.sigmas, 0.99), 4.0);
    // Pixels of a neighbour, up to a fifth of a sighting here, may move an end.
    EXPECT_LE(Errors::quantile(ring.ends.sigmas, 0.99), 6.0);
    EXPECT_LE(ring.merged, 0.2 * ring.sightings);
  }
}

/// With noise that is common to 5 × 5 pixels: 10 cm and 35 cm.
TEST(FaceErrors, StayBelowTenCentimetresWithCorrelatedNoise) {
  const Measured measured = along_the_forest(support::camera(5), 101);
  measured.print("camera 5x5");
  EXPECT_LE(Errors::quantile(measured.rings[1].faces.metres, 0.99), 0.10);
  EXPECT_LE(Errors::quantile(measured.rings[2].faces.metres, 0.99), 0.35);
  for (const Ring& ring : measured.rings) EXPECT_LE(Errors::quantile(ring.faces.sigmas, 0.99), 4.0);
}

TEST(FaceErrors, OfALidarStayBelowTwoCentimetres) {
  const Measured measured = along_the_forest(support::lidar(), 101);
  measured.print("lidar");
  EXPECT_LE(Errors::quantile(measured.rings[1].faces.metres, 0.99), 0.02);
  EXPECT_LE(Errors::quantile(measured.rings[2].faces.metres, 0.99), 0.02);
}

}  // namespace
}  // namespace tern
