#include "core/world/fence_set.h"
#include "core/world/inertial.h"
#include "core/world/landmark_densities.h"
#include "core/world/map_file.h"
#include "core/world/plan_heading.h"
#include "core/world/plan_unseen.h"
#include "core/world/pose_error.h"
#include "core/world/sighting.h"
#include "tests/support/generator_parts.h"

namespace tern::support {

template <>
SightingSet random_message(Rng& rng, Fill fill) {
  SightingSet set;
  set.header = header(rng);
  set.at = time(rng);
  set.sensor_id = random_integer(rng, 0, 1000);
  set.left_out = random_integer(rng, 0, 1000);
  SensorView& view = set.view;
  view.kind = enumerator(rng, ViewKind::Spherical);
  view.sensor_position = position(rng);
  view.q_WC = quaternion(rng);
  for (double* angle : {&view.left, &view.right, &view.up, &view.down}) *angle = number(rng, 0.0, 1.5);
  view.near_m = number(rng, 0.0, kMaxCoordinate);
  view.range_m = positive(rng, kMaxCoordinate);
  view.depth_sigma = number(rng, 0.0, kMaxCoordinate);
  view.depth_sigma_per_square_m = number(rng, 0.0, kMaxCoordinate);
  view.unit_m = positive(rng, 1e3);
  view.columns = fill == Fill::Largest ? 64 : random_integer(rng, 1, 64);
  view.rows = count(rng, fill, 0, kMaxViewCells / view.columns);
  for (int k = 0; k < view.rows * view.columns; ++k)
    view.depths.push_back(static_cast<std::int16_t>(random_integer(rng, -32'768, 32'767)));
  set.sightings.resize(static_cast<std::size_t>(count(rng, fill, 0, kMaxSightings)));
  for (Sighting& sighting : set.sightings) {
    const Vec3 corner = position(rng);
    const Vec3 other = position(rng);
    sighting.lower = corner.cwiseMin(other);
    sighting.upper = corner.cwiseMax(other);
    sighting.lower_sigma = extents(rng);
    sighting.upper_sigma = extents(rng);
    for (BoundSight& bound : sighting.bounds) bound = enumerator(rng, BoundSight::Unseen);
    sighting.points = random_integer(rng, 1, 10'000);
  }
  return set;
}

template <>
MapFile random_message(Rng& rng, Fill fill) {
  MapFile file;
  file.header = header(rng);
  file.at = time(rng);
  file.origin = position(rng);
  file.parts = random_integer(rng, 1, kMaxMapFileParts);
  file.part = random_integer(rng, 0, file.parts - 1);
  file.bytes.resize(static_cast<std::size_t>(count(rng, fill, 0, kMaxMapFileBytesPerMessage)));
  for (std::int8_t& byte : file.bytes) byte = static_cast<std::int8_t>(random_integer(rng, -128, 127));
  return file;
}

template <>
FenceSet random_message(Rng& rng, Fill fill) {
  const auto point = [&rng] { return Eigen::Vector2d(position(rng).head<2>()); };
  FenceSet set;
  set.header = header(rng);
  set.fences.resize(static_cast<std::size_t>(count(rng, fill, 0, kMaxFencesPerMessage)));
  int corners = set.fences.empty() ? 0 : kMaxFenceCornersPerMessage;
  for (Fence& fence : set.fences) {
    fence.is_inclusion = flag(rng);
    fence.shape = FenceCircle{point(), positive(rng, kMaxCoordinate)};
    if (corners < 3 || (fill == Fill::Mixed && flag(rng))) continue;
    FencePolygon polygon;
    const int n = fill == Fill::Largest ? corners : random_integer(rng, 3, std::min(corners, 20));
    for (int k = 0; k < n; ++k) polygon.corners.push_back(point());
    corners -= n;
    fence.shape = polygon;
  }
  return set;
}

template <>
PlanUnseen random_message(Rng& rng, Fill) {
  const auto clear = [&rng] { return Duration{integer(rng, 0, kMaxSpan.us)}; };
  return {header(rng), integer(rng, 1, kMaxCounter), name(rng), time(rng), clear(), clear()};
}

template <>
PoseError random_message(Rng& rng, Fill) {
  PoseError error;
  error.header = header(rng);
  error.set = integer(rng, 1, kMaxCounter);
  error.position = position(rng);
  for (double& x : error.pose_covariance) x = number(rng, -1e12, 1e12);
  error.apart = number(rng, 0.0, kMaxCoordinate);
  return error;
}

template <>
LandmarkDensities random_message(Rng& rng, Fill fill) {
  LandmarkDensities of;
  of.header = header(rng);
  of.tracks = static_cast<std::uint64_t>(integer(rng, 0, kMaxCounter));
  of.map_version = static_cast<std::uint64_t>(integer(rng, 0, kMaxCounter));
  of.densities.obstacles = number(rng, 0.0, kMaxLandmarkDensity);
  of.densities.by_class.resize(static_cast<std::size_t>(count(rng, fill, 1, kMaxSurfaceClasses)));
  for (double& density : of.densities.by_class) density = number(rng, 0.0, kMaxLandmarkDensity);
  of.statics = name_of(of);
  return of;
}

template <>
PlanHeading random_message(Rng& rng, Fill fill) {
  PlanHeading heading;
  heading.header = header(rng);
  heading.request_id = integer(rng, 1, kMaxCounter);
  heading.request = name(rng);
  heading.start = time(rng);
  heading.interval = interval(rng);
  heading.rate_max = positive(rng, 1e6);
  heading.acceleration_max = positive(rng, 1e6);
  for (double* term : {&heading.path_term, &heading.track_term, &heading.unseen_term, &heading.texture_term})
    *term = number(rng, -1e9, 1e9);
  heading.control_points.resize(static_cast<std::size_t>(count(rng, fill, kMinControlPoints, kMaxControlPoints)));
  for (double& yaw : heading.control_points) yaw = number(rng, -1e6, 1e6);
  return heading;
}

template <>
ImuBatch random_message(Rng& rng, Fill fill) {
  ImuBatch batch;
  batch.header = header(rng);
  batch.sensor_id = random_integer(rng, 0, 1000);
  batch.saturation_rate = number(rng, 0.0, kMaxCoordinate);
  batch.saturation_force = number(rng, 0.0, kMaxCoordinate);
  batch.samples.resize(static_cast<std::size_t>(count(rng, fill, 1, kMaxImuSamples)));
  std::int64_t at = integer(rng, -kMaxTimeUs, kMaxTimeUs - 1'000'000);
  for (ImuSample& sample : batch.samples) {
    sample.at.us = at += random_integer(rng, 1, 2'000);
    sample.angular_velocity = position(rng);
    sample.specific_force = position(rng);
  }
  return batch;
}

template <>
FeatureFrame random_message(Rng& rng, Fill fill) {
  FeatureFrame frame;
  frame.header = header(rng);
  frame.at = time(rng);
  frame.sensor_id = random_integer(rng, 0, 1000);
  frame.p_BC = position(rng);
  frame.q_BC = quaternion(rng);
  frame.baseline_m = positive(rng, kMaxCoordinate);
  frame.sigma = positive(rng, kMaxCoordinate);
  const int features = count(rng, fill, 0, kMaxFeatures);
  for (const std::int64_t id : different_ids(rng, features)) {
    StereoFeature& feature = frame.features.emplace_back();
    feature.id = id;
    feature.left = position(rng).head<2>();
    feature.right = position(rng).head<2>();
    feature.has_right = flag(rng);
  }
  return frame;
}

template <>
PositionFix random_message(Rng& rng, Fill) {
  PositionFix fix;
  fix.header = header(rng);
  fix.at = time(rng);
  fix.sensor_id = random_integer(rng, 0, 1000);
  fix.position = position(rng);
  for (double& variance : fix.variance) variance = positive(rng, 1e12);
  fix.has_yaw = flag(rng);
  fix.yaw = number(rng, -3.0, 3.0);
  fix.yaw_variance = positive(rng, 1e12);
  return fix;
}

template <>
Odometry random_message(Rng& rng, Fill) {
  Odometry odometry;
  odometry.header = header(rng);
  odometry.at = time(rng);
  odometry.state = enumerator(rng, EstimatorState::Lost);
  odometry.epoch = integer(rng, 0, kMaxCounter);
  odometry.q_OB = quaternion(rng);
  for (Vec3* x : {&odometry.p_OB, &odometry.v_OB, &odometry.angular_velocity, &odometry.p_WO, &odometry.gyroscope_bias,
                  &odometry.accelerometer_bias})
    *x = position(rng);
  odometry.yaw_WO = number(rng, -3.0, 3.0);
  for (double& x : odometry.pose_covariance) x = number(rng, -1e12, 1e12);
  for (double& x : odometry.velocity_covariance) x = number(rng, -1e12, 1e12);
  for (double& x : odometry.drift_covariance) x = number(rng, -1e12, 1e12);
  odometry.tracks = random_integer(rng, 0, 1000);
  odometry.rejected = random_integer(rng, 0, 1000);
  return odometry;
}

}  // namespace tern::support
