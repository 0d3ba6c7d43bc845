#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/world/frames.h"
#include "core/world/stated_bound.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// √χ² of three degrees of freedom at 99 %: half-axes of the ellipsoid over standard deviations.
const double kBound = std::sqrt(kChiSquared3);
/// The truth and a frame of features stand for the estimate's time up to this difference.
constexpr Duration kSameTime{150'000};
/// Features farther than this are left out: their distance by disparity says nothing, m.
constexpr double kFeatureRange = 40.0;
/// A feature within this distance of a moving obstacle's true box belongs to it, m.
constexpr double kOnMover = 0.3;
/// Slower obstacles count as standing, m/s.
constexpr double kMoves = 0.05;

using Mat3 = Eigen::Matrix3d;

bool is_valid(const Odometry& odometry) {
  return odometry.state == EstimatorState::Tracking || odometry.state == EstimatorState::Blind;
}

OdometryOffset offset_of(const Odometry& odometry) { return {odometry.p_WO, odometry.yaw_WO, odometry.epoch}; }

Vec3 place_of(const Odometry& odometry) { return offset_of(odometry).to_W(PointInO{odometry.p_OB}).xyz; }

/// Returns the half-axes of the 99 % ellipsoid of the position as columns, W.
std::pair<Vec3, Mat3> ellipsoid_of(const Odometry& odometry) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(position_covariance(odometry.pose_covariance));
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  return {kBound * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), axes};
}

/// Returns the true position at the estimate's time; nullopt if it is not known.
std::optional<Vec3> truth_at(const Scene& scene, UTime at) {
  const auto& truth = scene.true_state();
  if (!truth || at - truth->at > kSameTime || truth->at - at > kSameTime) return std::nullopt;
  return truth->motion.p + (at - truth->at).seconds() * truth->motion.v;
}

bool is_on_mover(const Scene& scene, const Vec3& p, UTime at) {
  if (!scene.truth()) return false;
  const double since = (at - scene.truth()->at).seconds();
  return std::ranges::any_of(scene.truth()->obstacles, [&](const TrueObstacle& o) {
    if (o.velocity.norm() < kMoves) return false;
    return box_around(o.position + since * o.velocity, o.half_extents).exteriorDistance(p) < kOnMover;
  });
}

/// Writes the features of the newest frame where their disparity puts them.
void write_features(JsonWriter& json, const Scene& scene) {
  const Odometry& odometry = *scene.odometry();
  json.begin_list();
  const auto& frame = scene.features();
  if (frame && odometry.at - frame->at <= kSameTime && frame->at - odometry.at <= kSameTime) {
    const auto turn = [](const Eigen::Vector4d& q) { return Eigen::Quaterniond(q[0], q[1], q[2], q[3]); };
    const Eigen::Quaterniond q_WB(Eigen::AngleAxisd(odometry.yaw_WO, Vec3::UnitZ()) * turn(odometry.q_OB));
    for (const StereoFeature& feature : frame->features) {
      const double disparity = feature.left.x() - feature.right.x();
      if (!feature.has_right || disparity * kFeatureRange <= frame->baseline_m) continue;
      const Vec3 p_C = frame->baseline_m / disparity * Vec3(feature.left.x(), feature.left.y(), 1.0);
      const Vec3 p = place_of(odometry) + q_WB * (frame->p_BC + turn(frame->q_BC) * p_C);
      json.point(p).number(is_on_mover(scene, p, frame->at) ? 1.0 : 0.0);
      json.number(feature.left.x()).number(feature.left.y());
    }
  }
  json.end_list();
}

}  // namespace

std::string estimate_json(const Scene& scene) {
  if (!scene.odometry() || !is_valid(*scene.odometry())) return "null";
  const Odometry& odometry = *scene.odometry();
  const auto [half, axes] = ellipsoid_of(odometry);
  const Eigen::Quaterniond q(axes);
  JsonWriter json;
  json.begin_object().key("at_us").integer(odometry.at.us).key("p").vec3(place_of(odometry)).key("half").vec3(half);
  json.key("q").begin_list();
  for (const double x : {q.w(), q.x(), q.y(), q.z()}) json.number(x);
  json.end_list();
  if (const auto truth = truth_at(scene, odometry.at)) {
    json.key("truth").vec3(*truth).key("truth_yaw").number(scene.true_state()->yaw);
  }
  json.key("blind").flag(odometry.state == EstimatorState::Blind).key("tracks").integer(odometry.tracks);
  if (scene.features()) json.key("features_us").integer(scene.features()->at.us);
  json.key("features");
  write_features(json, scene);
  return json.end_object().take();
}

NumberFields estimate_numbers(const Scene& scene) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double error = kNone, bound = kNone;
  if (scene.odometry() && is_valid(*scene.odometry())) {
    const Odometry& odometry = *scene.odometry();
    bound = ellipsoid_of(odometry).first.maxCoeff();
    if (const auto truth = truth_at(scene, odometry.at)) error = (*truth - place_of(odometry)).norm();
  }
  const double tracks = scene.odometry() ? scene.odometry()->tracks : kNone;
  return {{"estimate.error_m", error}, {"estimate.bound_m", bound}, {"estimate.tracks", tracks}};
}

}  // namespace tern
