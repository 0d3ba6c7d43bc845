#include "tests/support/vio_flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/world/vehicle.h"
#include "estimator/filter/feature.h"
#include "estimator/filter/rotation.h"

namespace tern::support {
namespace {

using Eigen::Matrix3d;

constexpr double kLeastGrazing = 0.14;  ///< sine of 8°

Matrix3d attitude(const Vec3& acceleration, double yaw) {
  const Vec3 z = (acceleration + Vec3(0.0, 0.0, kGravity)).normalized();
  const Vec3 y = z.cross(Vec3(std::cos(yaw), std::sin(yaw), 0.0)).normalized();
  Matrix3d R;
  R << y.cross(z), y, z;
  return R;
}

Vec3 normals(Rng& random) { return {random.normal(), random.normal(), random.normal()}; }

/// The camera's axes in B: z forward, x right, y down.
Matrix3d forward_camera() {
  Matrix3d R;
  R << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return R;
}

/// The guide's motion: at rest before time 0.
Vec3 velocity_at(const VioPath& path, double t) { return t <= 0.0 ? Vec3(Vec3::Zero()) : path.velocity(t); }

}  // namespace

std::vector<Vec3> landmarks_of(const VioWorld& world, std::uint64_t seed) {
  Rng random(seed);
  std::vector<Vec3> out;
  const auto add = [&](double density, double area, const std::function<Vec3()>& draw) {
    const int count = static_cast<int>(density * area);
    for (int k = 0; k < count; ++k) {
      const Vec3 x = draw();
      if (x.x() < world.bare.first || x.x() > world.bare.second) out.push_back(x);
    }
  };
  const auto along = [&] { return random.uniform(-10.0, world.length - 10.0); };
  add(world.ground, world.length * 2.0 * world.wall_y, [&] {
    const double x = along();
    return Vec3(x, random.uniform(-world.wall_y, world.wall_y), 0.0);
  });
  for (const double side : {-1.0, 1.0}) {
    add(world.wall, world.length * world.wall_height, [&, side] {
      const double x = along();
      return Vec3(x, side * world.wall_y, random.uniform(0.0, world.wall_height));
    });
  }
  return out;
}

VioPath weaving(double speed) {
  VioPath path;
  path.velocity = [speed](double t) {
    const double ramp = t < 2.0 ? 0.5 * (1.0 - std::cos(0.5 * std::numbers::pi * t)) : 1.0;
    return Vec3(speed * ramp, 1.5 * std::sin(0.9 * t), 0.3 * std::sin(0.7 * t));
  };
  path.yaw = [](double t) { return t <= 0.0 ? 0.0 : 0.25 * (1.0 - std::cos(0.6 * t)); };
  return path;
}

FeatureFrame FeatureTracker::see(const NavState& truth, const std::vector<Vec3>& landmarks, UTime at, bool dark) {
  FeatureFrame frame;
  frame.at = at;
  frame.p_BC = camera_.p_BC;
  const Matrix3d R_BC = forward_camera();
  const Eigen::Quaterniond q(R_BC);
  frame.q_BC = {q.w(), q.x(), q.y(), q.z()};
  frame.baseline_m = camera_.baseline;
  frame.sigma = camera_.deviation_px / camera_.focal;

  const Matrix3d R_CW = (truth.R * R_BC).transpose();
  const Vec3 p_WC = truth.p + truth.R * camera_.p_BC;
  const double tan_x = 0.5 * camera_.width / camera_.focal, tan_y = 0.5 * camera_.height / camera_.focal;
  const auto in_camera = [&](std::size_t k) -> Vec3 { return R_CW * (landmarks[k] - p_WC); };
  const auto visible = [&](const Vec3& x, const Vec3& landmark) {
    if (dark || x.z() < 0.3 || x.norm() > camera_.range) return false;
    if (std::abs(x.x()) > tan_x * x.z() || std::abs(x.y()) > tan_y * x.z()) return false;
    // Landmarks with z = 0 lie on the ground, all others on walls along x.
    const Vec3 ray = (landmark - p_WC).normalized();
    return std::abs(landmark.z() == 0.0 ? ray.z() : ray.y()) > kLeastGrazing;
  };

  std::vector<std::pair<std::size_t, std::int64_t>> kept;
  std::set<std::size_t> taken;
  for (const auto& [landmark, id] : tracks_) {
    const bool lost = random_.uniform() < camera_.loss;
    if (lost || !visible(in_camera(landmark), landmarks[landmark])) continue;
    kept.emplace_back(landmark, id);
    taken.insert(landmark);
  }
  std::vector<std::size_t> fresh;
  for (std::size_t k = 0; k < landmarks.size(); ++k) {
    if (!taken.contains(k) && visible(in_camera(k), landmarks[k])) fresh.push_back(k);
  }
  while (!fresh.empty() && kept.size() < idx(camera_.most_tracks)) {
    const auto pick = static_cast<std::size_t>(random_.uniform() * static_cast<double>(fresh.size()));
    kept.emplace_back(fresh[pick], next_id_++);
    fresh[pick] = fresh.back();
    fresh.pop_back();
  }
  tracks_ = kept;
  for (const auto& [landmark, id] : tracks_) {
    Vec3 x = in_camera(landmark);
    if (random_.uniform() < camera_.wrong) x += 0.1 * x.z() * normals(random_).cwiseProduct(Vec3(1.0, 1.0, 0.0));
    const Vec3 right = x - Vec3(camera_.baseline, 0.0, 0.0);
    StereoFeature feature;
    feature.id = id;
    feature.left = projected(x) + frame.sigma * normals(random_).head<2>();
    feature.right = projected(right) + frame.sigma * normals(random_).head<2>();
    frame.features.push_back(feature);
  }
  return frame;
}

std::vector<VioEvent> simulate(const VioPath& path, const std::vector<Vec3>& landmarks, const VioSettings& settings,
                               std::uint64_t seed) {
  Rng random(seed);
  FeatureTracker tracker(settings.camera, seed + 1'000'003);
  const double h = 1.0 / settings.imu_hz;
  const auto every = static_cast<int>(settings.imu_hz / settings.camera.rate_hz);
  const int from = -static_cast<int>(path.rest * settings.imu_hz), to = static_cast<int>(path.duration / h);
  NavState truth;
  truth.R = attitude(Vec3::Zero(), path.yaw(0.0));
  truth.p = path.start;
  truth.gyro_bias = settings.gyro_bias * normals(random);
  truth.accel_bias = settings.accel_bias * normals(random);
  std::vector<VioEvent> events;
  for (int k = from; k < to; ++k) {
    const double t = (k + 1) * h;
    const Vec3 acceleration = (velocity_at(path, t + h) - velocity_at(path, t - h)) / (2.0 * h);
    const Vec3 turn = log_rotation(truth.R.transpose() * attitude(acceleration, path.yaw(t)));
    const Vec3 g(0.0, 0.0, -kGravity);
    const Vec3 force =
        rotation_integrals(turn).first.inverse() * truth.R.transpose() * ((velocity_at(path, t) - truth.v) / h - g);
    const ImuStep exact{turn / h + truth.gyro_bias, force + truth.accel_bias, h};
    truth = moved(truth, exact, kGravity);

    VioEvent event;
    event.t = t;
    const UTime at{10'000'000 + static_cast<std::int64_t>(std::llround(t * 1e6))};
    event.sample = {at, exact.rate + settings.noise.gyro / std::sqrt(h) * normals(random),
                    exact.force + settings.noise.accel / std::sqrt(h) * normals(random)};
    event.truth = truth;
    events.push_back(event);
    truth.gyro_bias += settings.noise.gyro_walk * std::sqrt(h) * normals(random);
    truth.accel_bias += settings.noise.accel_walk * std::sqrt(h) * normals(random);
    if ((k + 1 - from) % every != 0) continue;
    event.is_frame = true;
    const bool dark =
        std::ranges::any_of(settings.dark, [t](const auto& span) { return t >= span.first && t < span.second; });
    event.frame = tracker.see(event.truth, landmarks, at, dark);
    events.push_back(event);
  }
  return events;
}

VioError error_of_estimate(const Estimate& estimate, const NavState& truth) {
  const PoseInW pose = estimate.pose_in_W();
  Eigen::Matrix<double, 6, 1> e;
  e << log_rotation(truth.R * pose.R.transpose()), truth.p - pose.p;
  const Eigen::Matrix<double, 6, 6> P = estimate.covariance.topLeftCorner<6, 6>();
  const Vec3 dp = e.tail<3>();
  const Matrix3d P_p = P.bottomRightCorner<3, 3>();
  return {e.dot(P.ldlt().solve(e)), dp.norm(), dp.dot(P_p.ldlt().solve(dp)), std::sqrt(P_p.trace())};
}

}  // namespace tern::support
