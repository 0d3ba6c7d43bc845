#include "simulator/app/vio_sensors.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/base/digest.h"
#include "messages/codec.h"

namespace tern {
namespace {

/// Least stated error of a coordinate, pixels: an estimator needs one above 0.
constexpr double kMinNoise = 0.1;

std::vector<Box> present_boxes(const World& world, double t_s) {
  std::vector<Box> boxes;
  for (const WorldObstacle& obstacle : world.obstacles) {
    if (obstacle.present(t_s)) boxes.push_back(obstacle.box(t_s));
  }
  return boxes;
}

}  // namespace

VioSensors::VioSensors(Bus& bus, const World& world, const Scenario& scenario, const VioConfig& config,
                       Navigation& navigation)
    : bus_(bus),
      world_(world),
      camera_(config.navigation.camera),
      tracks_(config.tracks),
      dark_(config.dark),
      navigation_(navigation),
      field_(world, scenario.semantics.regions, config.landmarks, scenario.seed),
      tracker_(config.tracks, digest("tracks", scenario.seed)),
      tags_(config.tags, digest("tags", scenario.seed)) {
  bus_.subscribe(channels::kOdometry, [this](const Odometry& odometry) { navigation_.receive(odometry); });
}

bool VioSensors::is_dark(double world_s) const {
  return std::ranges::any_of(dark_, [world_s](const DarkSpan& s) { return world_s >= s.from_s && world_s < s.to_s; });
}

FeatureFrame VioSensors::tracked(const CameraFrame& camera, UTime at, const std::vector<Landmark>& landmarks) {
  const double focal = camera_.focal_px();
  const Eigen::Vector2d centre(0.5 * camera_.width, 0.5 * camera_.height);
  FeatureFrame frame;
  frame.at = at;
  const Eigen::Quaterniond q(camera_.camera_to_body());
  frame.q_BC = {q.w(), q.x(), q.y(), q.z()};
  frame.baseline_m = camera_.baseline_m;
  frame.sigma = std::max(tracks_.noise_px, kMinNoise) / focal;
  for (const SimulatedTrack& track : tracker_.observe(camera, landmarks)) {
    const Eigen::Vector2d right = track.in_right ? track.right : centre;
    frame.features.push_back({track.id, (track.left - centre) / focal, (right - centre) / focal, track.in_right});
  }
  return frame;
}

void VioSensors::look(const StereoExposure& exposure, double world_s) {
  const CameraFrame camera(camera_, exposure.truth, exposure.rate, present_boxes(world_, world_s));
  if (is_dark(world_s)) {
    bus_.publish(channels::kFeatureTracks, tracked(camera, exposure.at, {}));
    return;
  }
  const double grazing = camera_.grazing_deg * std::numbers::pi / 180.0;
  const auto landmarks = field_.around(exposure.truth.p, camera_.range_m, grazing, world_s);
  bus_.publish(channels::kFeatureTracks, tracked(camera, exposure.at, landmarks));
  for (const PositionFix& fix : tags_.look(camera, exposure.truth.p, exposure.at))
    bus_.publish(channels::kPositionFix, fix);
}

void VioSensors::publish(std::optional<UTime> world_zero) {
  const std::vector<ImuSample> samples = navigation_.take_samples();
  for (auto from = samples.begin(); from != samples.end();) {
    const auto to = from + std::min<std::ptrdiff_t>(samples.end() - from, kMaxImuSamples);
    ImuBatch batch;
    batch.samples.assign(from, to);
    bus_.publish(channels::kImu, std::move(batch));
    from = to;
  }
  for (const StereoExposure& exposure : navigation_.take_exposures()) {
    const double world_s = world_zero ? std::max(0.0, (exposure.at - *world_zero).seconds()) : 0.0;
    look(exposure, world_s);
  }
}

}  // namespace tern
