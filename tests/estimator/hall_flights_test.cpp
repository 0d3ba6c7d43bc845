// Flights by simulated cameras through a dark hall: the stated bound holds while hardly anything is seen, and before
// and after. The landmarks are those of scenarios/hall.yaml.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "core/world/vehicle.h"
#include "estimator/estimator.h"
#include "estimator/filter/feature.h"
#include "estimator/filter/rotation.h"
#include "simulator/inertial/imu.h"
#include "simulator/inertial/track_simulator.h"
#include "tests/support/effort.h"
#include "tests/support/vio_flight.h"

namespace tern {
namespace {

constexpr double kStep = 0.005, kRest = 3.0;  // s
constexpr int kSamplesPerFrame = 10;

/// A floor and pillars with hardly a landmark, and one wall with many beside the middle of the way.
struct Hall {
  World world;
  std::vector<Region> regions{{"wall", "texture", Box(Vec3(20.0, -9.0, 0.0), Vec3(50.0, -5.0, 4.0))}};
  LandmarkSpec landmarks;
  std::vector<Box> boxes;

  Hall() {
    landmarks.ground = 0.03;
    landmarks.obstacles = landmarks.movers = 0.5;
    for (const double y : {1.0, -2.0, 2.0, -1.0, 1.0, -2.0, 2.0, -1.0}) {
      ObstacleSpec spec;
      spec.name = "pillar_" + std::to_string(boxes.size() + 1);
      spec.centre = Vec3(10.0 + 8.0 * static_cast<double>(boxes.size()), y, 2.0);
      spec.half_extents = Vec3(0.3, 0.3, 2.0);
      world.obstacles.push_back(WorldObstacle::make(std::ssize(boxes), spec).value());
      boxes.push_back(world.obstacles.back().box(0.0));
    }
  }
};

/// The velocity of a slow way past the pillars. The hall is 75 m long.
Vec3 velocity(double t) {
  const double ramp = t < 2.0 ? 0.5 * (1.0 - std::cos(0.5 * std::numbers::pi * std::max(t, 0.0))) : 1.0;
  return ramp * Vec3(1.7 + 0.85 * std::sin(0.8 * t), std::sin(0.5 * t), 0.1 * std::sin(0.7 * t));
}

Mat3 attitude(const Vec3& acceleration) {
  const Vec3 z = (acceleration + Vec3(0.0, 0.0, kGravity)).normalized();
  const Vec3 y = z.cross(Vec3::UnitX()).normalized();
  Mat3 R;
  R << y.cross(z), y, z;
  return R;
}

/// Instants at which the camera has few features or many, and how far the truth was from the estimate.
struct Coverage {
  std::int64_t instants = 0, covered = 0;
  double nees = 0.0;  ///< sum of the position's, 3 degrees of freedom
  [[nodiscard]] double share() const { return static_cast<double>(covered) / static_cast<double>(instants); }
  [[nodiscard]] double anees() const { return nees / 3.0 / static_cast<double>(instants); }
};

struct Record {
  std::array<Coverage, 3> by_view;  ///< at most 2 features, 3 to 9, more
  double end_nees = 0.0;
  [[nodiscard]] double coverage() const {
    std::int64_t instants = 0, covered = 0;
    for (const Coverage& view : by_view) {
      instants += view.instants;
      covered += view.covered;
    }
    return static_cast<double>(covered) / static_cast<double>(instants);
  }
};

FeatureFrame frame_of(const std::vector<SimulatedTrack>& tracks, const StereoSpec& camera, double noise_px, UTime at) {
  FeatureFrame frame;
  frame.at = at;
  const Eigen::Quaterniond q(camera.camera_to_body());
  frame.q_BC = {q.w(), q.x(), q.y(), q.z()};
  frame.baseline_m = camera.baseline_m;
  const double focal = camera.focal_px();
  frame.sigma = noise_px / focal;
  const Eigen::Vector2d centre(0.5 * camera.width, 0.5 * camera.height);
  for (const SimulatedTrack& track : tracks) {
    const Eigen::Vector2d right = track.in_right ? track.right : centre;
    frame.features.push_back({track.id, (track.left - centre) / focal, (right - centre) / focal, track.in_right});
  }
  return frame;
}

void add(Record& record, const Estimate& estimate, const InertialState& truth, std::size_t features) {
  const support::VioError error = support::error_of_estimate(estimate, {truth.R, truth.p, truth.v});
  Coverage& coverage = record.by_view[features < 3 ? 0 : features < 10 ? 1 : 2];
  ++coverage.instants;
  coverage.covered += error.position_nees < 11.345 ? 1 : 0;
  coverage.nees += error.position_nees;
}

void fly(const Hall& hall, const TrackSpec& spec, std::uint64_t seed, Record& record) {
  const StereoSpec camera;
  LandmarkField field(hall.world, hall.regions, hall.landmarks, seed);
  TrackSimulator tracker(spec, seed);
  SimulatedImu imu({}, seed);
  InertialState truth;
  truth.p = Vec3(0.0, 0.0, 1.0);
  Estimator estimator({}, {PointInW{truth.p}, 0.0});
  double nees = 0.0;
  for (int k = -static_cast<int>(kRest / kStep); truth.p.x() < 75.0; ++k) {
    const double t = (k + 1) * kStep;
    InertialState next;
    next.v = velocity(t);
    next.R = attitude((velocity(t + kStep) - velocity(t - kStep)) / (2.0 * kStep));
    const InertialSample exact = sample_between(truth, next, kStep);
    truth = strapdown(truth, exact, kStep);
    const InertialSample measured = imu.measure(exact, kStep);
    const UTime at{10'000'000 + static_cast<std::int64_t>(std::llround(t * 1e6))};
    estimator.add(ImuSample{at, measured.rate, measured.force});
    if (k % kSamplesPerFrame != 0) continue;
    const CameraFrame exposure(camera, truth, exact.rate, hall.boxes);
    const auto landmarks = field.around(truth.p, camera.range_m, camera.grazing_deg * std::numbers::pi / 180.0, 0.0);
    const FeatureFrame frame = frame_of(tracker.observe(exposure, landmarks), camera, spec.noise_px, at);
    estimator.add(frame);
    if (t <= 0.0) continue;
    const Estimate estimate = estimator.estimate().value();
    add(record, estimate, truth, frame.features.size());
    nees = support::error_of_estimate(estimate, {truth.R, truth.p, truth.v}).position_nees;
  }
  record.end_nees += nees;
}

Record flown(const TrackSpec& spec, int flights) {
  const Hall hall;
  Record record;
  for (int seed = 1; seed <= flights; ++seed) fly(hall, spec, static_cast<std::uint64_t>(seed), record);
  for (const Coverage& view : record.by_view) {
    std::printf("instants %6d: ANEES %.2f, inside the 99 %% bound %.4f\n", static_cast<int>(view.instants),
                view.anees(), view.share());
  }
  std::printf("NEES at the end: %.1f of %d\n", record.end_nees, 3 * flights);
  return record;
}

/// The sum of the flights' NEES at the end is χ² with 3 degrees of freedom each: its bounds at 99.9 %.
void expect_consistent(const Record& record, int flights) {
  EXPECT_LT(record.end_nees, chi_square_quantile(3 * flights, 3.29));
  EXPECT_GT(record.end_nees, chi_square_quantile(3 * flights, -3.29));
  EXPECT_GT(record.coverage(), 0.98);
}

TEST(EstimatorHallFlights, ErrorsAreWhatTheCovarianceSays) {
  const int flights = std::max(4, support::at_effort(50));
  expect_consistent(flown({}, flights), flights);
}

TEST(EstimatorHallFlights, TracksThatSlipDoNotSpoilTheCovariance) {
  const int flights = std::max(4, support::at_effort(50));
  TrackSpec spec;
  spec.wrong = 0.01;  // five times as many as usual
  expect_consistent(flown(spec, flights), flights);
}

}  // namespace
}  // namespace tern
