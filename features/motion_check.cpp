#include "features/motion_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

#include "core/base/random.h"

namespace tern {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

constexpr int kGaussNewtonSteps = 4;
constexpr std::uint64_t kSeed = 1;
/// Nearer points are behind the image or in it, m.
constexpr double kNearest = 0.05;
/// A point of unknown depth is at least this far away, m.
constexpr double kNearestUnknown = 0.3;

/// The motion of the camera: x_now = R x_before + t.
struct Motion {
  Matrix3d R = Matrix3d::Identity();
  Vec3 t = Vec3::Zero();
};

Matrix3d cross_matrix(const Vec3& x) {
  Matrix3d S;
  S << 0.0, -x.z(), x.y(), x.z(), 0.0, -x.x(), -x.y(), x.x(), 0.0;
  return S;
}

/// Improves the motion so that it explains these points. @return false if they leave it undetermined
bool fit(Motion& motion, const std::vector<MovedPoint>& points, std::span<const int> subset) {
  for (int step = 0; step < kGaussNewtonSteps; ++step) {
    Eigen::Matrix<double, 6, 6> H = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> g = Eigen::Matrix<double, 6, 1>::Zero();
    for (const int k : subset) {
      const MovedPoint& point = points[idx(k)];
      const Vec3 turned = motion.R * point.before, x = turned + motion.t;
      if (x.z() < kNearest) return false;
      Eigen::Matrix<double, 2, 3> projection;
      projection << 1.0 / x.z(), 0.0, -x.x() / (x.z() * x.z()), 0.0, 1.0 / x.z(), -x.y() / (x.z() * x.z());
      Eigen::Matrix<double, 2, 6> J;
      J << -projection * cross_matrix(turned), projection;
      const Vector2d r = point.now - Vector2d(x.head<2>() / x.z());
      H.noalias() += J.transpose() * J;
      g.noalias() += J.transpose() * r;
    }
    const Eigen::Matrix<double, 6, 1> change = H.ldlt().solve(g);
    if (!change.allFinite() || change.head<3>().norm() > 1.0) return false;
    const double angle = change.head<3>().norm();
    if (angle > 0.0) motion.R = Eigen::AngleAxisd(angle, change.head<3>() / angle) * motion.R;
    motion.t += change.tail<3>();
  }
  return true;
}

/// Distance of `p` from the line between a and b.
double distance_to_line(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d line = b - a;
  const double length = line.squaredNorm();
  const double share = length > 0.0 ? std::clamp((p - a).dot(line) / length, 0.0, 1.0) : 0.0;
  return (p - a - share * line).norm();
}

/// How far a point is seen from where the motion takes it.
double miss(const Motion& motion, const MovedPoint& point) {
  const Vec3 turned = motion.R * point.before, x = turned + motion.t;
  constexpr double kBehind = std::numeric_limits<double>::infinity();
  if (point.has_depth) return x.z() < kNearest ? kBehind : (point.now - Vector2d(x.head<2>() / x.z())).norm();
  const double least = std::max(kNearestUnknown, 2.0 * motion.t.norm()) / point.before.norm();
  const Vec3 nearest = least * turned + motion.t;
  if (turned.z() <= 0.0 || nearest.z() < kNearest) return kBehind;
  return distance_to_line(point.now, turned.head<2>() / turned.z(), nearest.head<2>() / nearest.z());
}

/// The points of `among` that agree with the motion.
std::vector<int> agreeing(const Motion& motion, const std::vector<MovedPoint>& points, std::span<const int> among,
                          double sigma, double baseline) {
  const double seen_twice = motion.t.norm() / baseline;
  const double tolerance = kTolerance * sigma * std::sqrt(1.0 + seen_twice * seen_twice);
  std::vector<int> subset;
  for (const int k : among) {
    if (miss(motion, points[idx(k)]) <= tolerance) subset.push_back(k);
  }
  return subset;
}

double votes(const std::vector<MovedPoint>& points, std::span<const int> subset) {
  double sum = 0.0;
  for (const int k : subset) sum += points[idx(k)].weight;
  return sum;
}

}  // namespace

std::optional<std::vector<bool>> agree_with_motion(const std::vector<MovedPoint>& points, double sigma,
                                                   double baseline) {
  std::vector<int> all(points.size()), deep;
  std::iota(all.begin(), all.end(), 0);
  std::ranges::copy_if(all, std::back_inserter(deep), [&](int k) { return points[idx(k)].has_depth; });
  if (std::ssize(deep) < kLeastAgreeing) return std::nullopt;
  Rng random(kSeed);
  const auto draw = [&] { return deep[idx(static_cast<int>(random.uniform() * static_cast<double>(deep.size())))]; };
  Motion best;
  std::vector<int> most;
  for (int hypothesis = 0; hypothesis < kHypotheses; ++hypothesis) {
    const std::array<int, 3> sample{draw(), draw(), draw()};
    if (sample[0] == sample[1] || sample[1] == sample[2] || sample[0] == sample[2]) continue;
    Motion motion;
    if (!fit(motion, points, sample)) continue;
    std::vector<int> subset = agreeing(motion, points, deep, sigma, baseline);
    if (votes(points, subset) <= votes(points, most)) continue;
    most = std::move(subset);
    best = motion;
  }
  if (Motion refined = best; fit(refined, points, most)) best = refined;
  most = agreeing(best, points, deep, sigma, baseline);
  if (std::ssize(most) < kLeastAgreeing || 2.0 * votes(points, most) < votes(points, deep)) return std::nullopt;
  std::vector<bool> agrees(points.size(), false);
  for (const int k : agreeing(best, points, all, sigma, baseline)) agrees[idx(k)] = true;
  return agrees;
}

}  // namespace tern
