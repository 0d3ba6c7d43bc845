#include "planner/density_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/world/frames.h"
#include "core/world/pose_error.h"
#include "planner/semantics/seen_cells.h"

namespace tern {
namespace {

Eigen::Matrix3d rotation_of(const Eigen::Vector4d& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

/// The camera's pose at a frame shortly before an odometry: velocities are taken as constant between the two.
CameraPose camera_at(const FeatureFrame& frame, const Odometry& odometry) {
  const double dt = (odometry.at - frame.at).seconds();
  const Vec3 turn = -dt * odometry.angular_velocity;
  const double angle = turn.norm();
  PoseInO body{rotation_of(odometry.q_OB), odometry.p_OB - dt * odometry.v_OB};
  if (angle > 0.0) body.R = body.R * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  const PoseInW at = OdometryOffset{odometry.p_WO, odometry.yaw_WO, odometry.epoch}.to_W(body);
  CameraPose camera;
  camera.eye = at.p + at.R * frame.p_BC;
  camera.R_WC = at.R * rotation_of(frame.q_BC);
  camera.error.position = at.p;
  camera.error.pose_covariance = odometry.pose_covariance;
  return camera;
}

bool is_near(const Box& box, const Vec3& eye) { return box.exteriorDistance(eye) <= kNear; }

std::vector<Box> boxes_at_rest(const MapProducts& map, const PathObstacles& obstacles, const Vec3& eye) {
  std::vector<Box> near;
  for (const Box& box : obstacles.all()) {
    if (is_near(box, eye)) near.push_back(box);
  }
  for (const std::int32_t k : map.occupied.query(box_around(eye, Vec3::Constant(kNear)))) {
    near.push_back(map.occupied.boxes()[idx(k)]);
  }
  return near;
}

/// Returns the places of all other tracks at a time.
std::vector<Box> movers_at(UTime at, const TrackSet& set, const std::vector<Box>& resting, const Vec3& eye) {
  std::vector<Box> movers;
  for (const Track& track : set.tracks) {
    if (track.kind == TrackKind::Static) continue;
    const Box box = track.bounds(at, at);
    const bool is_resting =
        std::any_of(resting.begin(), resting.end(), [&](const Box& known) { return known.contains(box); });
    if (!is_resting && is_near(box, eye)) movers.push_back(box);
  }
  return movers;
}

std::string line(const std::string& kind, double promised, double seen) {
  char text[160];
  std::snprintf(text, sizeof text, ": %.2g landmarks/m² by its label, %.2g as seen", promised, seen);
  return kind + text;
}

}  // namespace

void DensityWatch::add(const FeatureFrame& frame) {
  const bool is_new = !last_ || frame.at - *last_ >= kPeriod;
  if (is_new && !waiting_ && !frame.features.empty()) waiting_ = frame;
}

void DensityWatch::begin(const MapProducts& map) {
  class_names_ = map.class_names;
  const SurfaceDensities& promised = map.surfaces.promised();
  densities_.emplace(promised);
  told_ = promised.by_class;
  told_.push_back(promised.obstacles);
}

std::vector<std::string> DensityWatch::add(const Odometry& odometry, const MapProducts& map,
                                           const PredictionProducts* predictions, const PathObstacles& obstacles) {
  if (!waiting_ || odometry.at < waiting_->at) return {};
  const FeatureFrame frame = *std::exchange(waiting_, std::nullopt);
  if (odometry.state != EstimatorState::Tracking || odometry.at - frame.at > kPairWithin) return {};
  if (predictions == nullptr || frame.at - predictions->set.made_at > kOldestTracks) return {};
  const CameraPose camera = camera_at(frame, odometry);
  if (camera.error.margin(camera.eye) > kMostError) return {};
  if (!densities_ || class_names_ != map.class_names) begin(map);
  const std::vector<Box> at_rest = boxes_at_rest(map, obstacles, camera.eye);
  const std::vector<Box> movers = movers_at(frame.at, predictions->set, obstacles.resting, camera.eye);
  const TextureCamera texture;
  const bool is_full = static_cast<double>(frame.features.size()) >= texture.most_tracks;
  last_ = frame.at;
  ++used_;
  const auto cells = seen_cells(frame, camera, {map.surfaces, at_rest, movers}, texture);
  return densities_->add(cells, is_full, frame.at) ? news() : std::vector<std::string>();
}

std::vector<std::string> DensityWatch::news() {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < told_.size(); ++k) {
    const bool is_obstacles = k + 1 == told_.size();
    const SurfaceKind kind = is_obstacles ? kObstacles : static_cast<SurfaceKind>(k);
    const double in_force = densities_->in_force(kind), blur = LabelDensities::kBlur;
    if (std::abs(std::log((in_force + blur) / (told_[k] + blur))) < std::log(2.0)) continue;
    told_[k] = in_force;
    const SurfaceDensities& promised = densities_->promised();
    const std::string name = is_obstacles ? "obstacles at rest" : k == 0 ? "open ground" : "class " + class_names_[k];
    lines.push_back(line(name, is_obstacles ? promised.obstacles : promised.by_class[k], in_force));
  }
  return lines;
}

std::optional<SurfaceDensities> DensityWatch::densities_for(const MapProducts& map) const {
  if (!densities_ || class_names_ != map.class_names) return std::nullopt;
  return densities_->in_force();
}

}  // namespace tern
