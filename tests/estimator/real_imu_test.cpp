// A real IMU in flight with its ground truth (EuRoC MH_05), under simulated features: 96 m by an aggressive vehicle
// whose vibration the default noise was made for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "estimator/estimator.h"
#include "estimator/filter/rotation.h"
#include "tests/support/effort.h"
#include "tests/support/vio_flight.h"

namespace tern {
namespace {

constexpr double kGravityThere = 9.81;

struct Truth {
  UTime at;
  NavState state;
};

struct Recording {
  std::vector<ImuSample> samples;
  std::vector<Truth> truth;

  /// @pre the time lies between two rows
  [[nodiscard]] NavState at(UTime t) const {
    const auto after =
        std::upper_bound(truth.begin(), truth.end(), t, [](UTime time, const Truth& row) { return time < row.at; });
    const Truth &a = *(after - 1), &b = *after;
    const double s = (t - a.at).seconds() / (b.at - a.at).seconds();
    NavState out = a.state;
    out.R = a.state.R * exp_rotation(s * log_rotation(a.state.R.transpose() * b.state.R));
    out.p = (1.0 - s) * a.state.p + s * b.state.p;
    out.v = (1.0 - s) * a.state.v + s * b.state.v;
    return out;
  }
};

Recording recording() {
  Recording out;
  std::ifstream imu(std::string(TERN_DATA_FOLDER) + "/vio/euroc_MH05_imu0.txt");
  std::int64_t ns = 0;
  ImuSample before, sample;
  while (imu >> ns >> sample.angular_velocity.x() >> sample.angular_velocity.y() >> sample.angular_velocity.z() >>
         sample.specific_force.x() >> sample.specific_force.y() >> sample.specific_force.z()) {
    sample.at = UTime{ns / 1000};
    // The file has values at instants; a sample is a mean over the time before it.
    ImuSample mean = sample;
    mean.angular_velocity = 0.5 * (sample.angular_velocity + before.angular_velocity);
    mean.specific_force = 0.5 * (sample.specific_force + before.specific_force);
    if (before.at.us != 0) out.samples.push_back(mean);
    before = sample;
  }
  std::ifstream rows(std::string(TERN_DATA_FOLDER) + "/vio/euroc_MH05_gt.csv");
  std::string line;
  std::getline(rows, line);
  while (std::getline(rows, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    Truth row;
    double x[16];
    text >> ns;
    for (double& value : x) text >> value;
    row.at = UTime{ns / 1000};
    row.state = {Eigen::Quaterniond(x[3], x[4], x[5], x[6]).normalized().toRotationMatrix(), Vec3(x[0], x[1], x[2]),
                 Vec3(x[7], x[8], x[9]), Vec3(x[10], x[11], x[12]), Vec3(x[13], x[14], x[15])};
    out.truth.push_back(row);
  }
  return out;
}

/// Landmarks on the walls, the floor and the ceiling of a hall around the path.
std::vector<Vec3> hall(const Recording& recording, std::uint64_t seed) {
  Eigen::AlignedBox3d box;
  for (const Truth& row : recording.truth) box.extend(row.state.p);
  const Vec3 low = box.min() - Vec3(4.0, 4.0, 2.0), high = box.max() + Vec3(4.0, 4.0, 4.0);
  Rng random(seed);
  std::vector<Vec3> out;
  for (int k = 0; k < 6000; ++k) {
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis) x[axis] = random.uniform(low[axis], high[axis]);
    const int face = static_cast<int>(random.uniform(0.0, 6.0));
    x[face % 3] = face < 3 ? low[face % 3] : high[face % 3];
    out.push_back(x);
  }
  return out;
}

struct Outcome {
  double end = 0.0, anees = 0.0, peak = 0.0;
  double coverage = 0.0;
};

/// Flies the recording; the camera is dark for `dark_s` in every 20 s.
Outcome flown(const Recording& recording, std::uint64_t seed, double dark_s) {
  EstimatorConfig config;
  config.gravity = kGravityThere;
  const UTime from = recording.truth.front().at + Duration{1'000'000}, to = recording.truth.back().at;
  const NavState first = recording.at(from);
  Estimator estimator(config);
  StartState start;
  start.at = from;
  start.pose = {first.R, first.p};
  start.velocity.xyz = first.v;
  start.gyro_bias = first.gyro_bias;
  start.accel_bias = first.accel_bias;
  estimator.start(start);

  support::VioCamera camera;
  camera.range = 40.0;
  support::FeatureTracker tracker(camera, seed);
  const std::vector<Vec3> landmarks = hall(recording, seed);
  Outcome out;
  int frames = 0, covered = 0, n = 0;
  for (const ImuSample& sample : recording.samples) {
    if (sample.at <= from || sample.at >= to) continue;
    estimator.add(sample);
    if (++n % 10 != 0) continue;
    const double t = (sample.at - from).seconds();
    const NavState truth = recording.at(sample.at);
    estimator.add(tracker.see(truth, landmarks, sample.at, dark_s > 0.0 && std::fmod(t, 20.0) > 20.0 - dark_s));
    const support::VioError error = support::error_of_estimate(estimator.estimate().value(), truth);
    ++frames;
    covered += error.position_nees < 11.345 ? 1 : 0;
    out.anees += error.nees / 6.0;
    out.peak = std::max(out.peak, error.position);
    out.end = error.position;
  }
  out.anees /= frames;
  out.coverage = static_cast<double>(covered) / frames;
  return out;
}

TEST(RealImu, EndsNearTheTruthWithinItsBound) {
  const Recording mh05 = recording();
  ASSERT_GT(mh05.samples.size(), 22'000u);
  const int seeds = std::max(2, support::at_effort(10));
  double squares = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Outcome out = flown(mh05, static_cast<std::uint64_t>(seed), 0.0);
    std::printf("seed %d: end %.3f m, peak %.3f m, ANEES %.2f, coverage %.4f\n", seed, out.end, out.peak, out.anees,
                out.coverage);
    EXPECT_LT(out.anees, 1.3) << seed;
    EXPECT_GT(out.coverage, 0.985) << seed;
    squares += out.end * out.end;
  }
  EXPECT_LT(std::sqrt(squares / seeds), 0.10);
}

TEST(RealImu, BlackoutsStayWithinTheBound) {
  const Recording mh05 = recording();
  for (const double dark : {3.0, 5.0}) {
    const Outcome out = flown(mh05, 2, dark);
    EXPECT_GT(out.coverage, 0.985) << dark;
    EXPECT_LT(out.anees, 1.3) << dark;
    std::printf("dark %.0f s in 20 s: end %.3f m, peak %.3f m, ANEES %.2f, coverage %.4f\n", dark, out.end, out.peak,
                out.anees, out.coverage);
  }
}

}  // namespace
}  // namespace tern
