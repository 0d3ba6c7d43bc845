#include "planner/semantics/seen_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/semantics/side_walk.h"

namespace tern {
namespace {

constexpr int kRaysAcross = 3;       ///< of a cell, per axis
constexpr SurfaceKind kHidden = -1;  ///< a mover, or a box about the camera
constexpr double kLeastDepth = 1.5;  ///< a nearer surface may be outside of the right image, m
constexpr double kDeviations = 3.0;  ///< of a disparity

/// A surface that a ray meets.
struct Hit {
  SurfaceKind kind = kOpenGround;
  double distance = 0.0;  ///< m
  double cosine = 1.0;    ///< of the angle between ray and normal, > 0
  double coarse = 0.0;    ///< uncertainty of its place, along its normal, m
};

/// The place where a ray enters a box, by the slab method. From inside: at once.
std::optional<Hit> entry(const Box& box, const Vec3& eye, const Vec3& u) {
  double enter = 0.0, leave = INFINITY, cosine = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis] - eye[axis], high = box.max()[axis] - eye[axis];
    if (std::abs(u[axis]) < 1e-12) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    const double first = low / u[axis], second = high / u[axis];
    if (std::min(first, second) > enter) {
      enter = std::min(first, second);
      cosine = std::abs(u[axis]);
    }
    leave = std::min(leave, std::max(first, second));
  }
  if (enter > leave) return std::nullopt;
  return Hit{enter > 0.0 ? kObstacles : kHidden, enter, cosine, 0.0};
}

/// Meets rays from one camera with the surfaces.
class Rays {
 public:
  Rays(const CameraPose& pose, const KnownSurfaces& surfaces, const TextureCamera& camera)
      : pose_(pose), surfaces_(surfaces), range_(camera.range_m), least_cosine_(std::sin(camera.grazing_rad)) {}

  /// Returns what the ray to a point of the image meets: the sides of regions, which hide nothing, then what ends it.
  [[nodiscard]] std::vector<Hit> along(const Eigen::Vector2d& image) const {
    const Vec3 u = (pose_.R_WC * image.homogeneous()).normalized();
    std::vector<Hit> hits;
    const std::optional<Hit> end = end_of(u);
    add_sides(u, end ? std::min(end->distance, range_) : range_, hits);
    if (end) hits.push_back(*end);
    std::erase_if(hits, [this](const Hit& hit) {
      return hit.kind != kHidden && (hit.distance > range_ || hit.cosine < least_cosine_);
    });
    return hits;
  }

 private:
  [[nodiscard]] std::optional<Hit> end_of(const Vec3& u) const {
    std::optional<Hit> end;
    const auto take = [&end](const std::optional<Hit>& hit) {
      if (hit && (!end || hit->distance < end->distance)) end = hit;
    };
    for (const Box& box : surfaces_.at_rest) take(entry(box, pose_.eye, u));
    for (const Box& box : surfaces_.movers) {
      auto hit = entry(box, pose_.eye, u);
      if (hit) hit->kind = kHidden;
      take(hit);
    }
    const double height = pose_.eye.z() - surfaces_.labels.ground_z();
    if (height <= 0.0 || u.z() > -1e-6) return end;
    const double distance = height / -u.z();
    const Vec3 p = pose_.eye + distance * u;
    take(Hit{surfaces_.labels.at(p.x(), p.y()).ground_kind, distance, -u.z(), 0.0});
    return end;
  }

  void add_sides(const Vec3& u, double until, std::vector<Hit>& hits) const {
    const double level = u.head<2>().norm();
    if (level < 1e-6) return;
    walk_sides(surfaces_.labels, pose_.eye, u.head<2>() / level, until * level,
               [&](const SurfaceColumn& side, double s, double cosine) {
                 const double distance = s / level, z = pose_.eye.z() + distance * u.z();
                 if (side.sides_kind == kObstacles || z < side.low || z > side.high) return;
                 hits.push_back({side.sides_kind, distance, cosine * level, SurfaceMap::kColumn});
               });
  }

  const CameraPose& pose_;
  const KnownSurfaces& surfaces_;
  double range_, least_cosine_;
};

/// Returns what a cell shows; nullopt if it is left out.
std::optional<SurfaceCell> cell_at(const Eigen::Vector2d& corner, const Rays& rays) {
  constexpr double kPart = kCell / kRaysAcross;
  SurfaceCell cell{kHidden, 0.0, false};
  for (int k = 0; k < kRaysAcross * kRaysAcross; ++k) {
    const Eigen::Vector2d image = corner + kPart * Eigen::Vector2d(k % kRaysAcross + 0.5, k / kRaysAcross + 0.5);
    const std::vector<Hit> hits = rays.along(image);
    if (hits.empty() || hits.front().distance > kNear) return std::nullopt;
    if (k == 0) cell.kind = hits.front().kind;
    const double angle = kPart * kPart / std::pow(image.squaredNorm() + 1.0, 1.5);  // sr
    for (const Hit& hit : hits) {
      if (hit.kind == kHidden || hit.kind != cell.kind) return std::nullopt;
      cell.area_m2 += angle * hit.distance * hit.distance / hit.cosine;
    }
  }
  return cell;
}

/// Whether a feature lies on one of the surfaces in its direction.
bool lies_on_surface(const StereoFeature& feature, const FeatureFrame& frame, const CameraPose& pose,
                     const Rays& rays) {
  const double n = std::sqrt(feature.left.squaredNorm() + 1.0);
  const Vec3 u = (pose.R_WC * feature.left.homogeneous()) / n;
  const double disparity = feature.left.x() - feature.right.x();
  const std::vector<Hit> hits = rays.along(feature.left);
  return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) {
    if (hit.kind == kHidden) return false;
    const double off = (pose.error.margin(pose.eye + hit.distance * u) + hit.coarse) / hit.cosine;  // along the ray
    const double per_metre = frame.baseline_m * n / (hit.distance * hit.distance);
    const double tolerance = kDeviations * std::numbers::sqrt2 * frame.sigma + per_metre * off;
    return std::abs(disparity - frame.baseline_m * n / hit.distance) <= tolerance;
  });
}

}  // namespace

std::vector<SurfaceCell> seen_cells(const FeatureFrame& frame, const CameraPose& pose, const KnownSurfaces& surfaces,
                                    const TextureCamera& camera) {
  const Rays rays(pose, surfaces, camera);
  const int half_columns = static_cast<int>(std::tan(0.5 * camera.view_rad) / kCell);
  const int half_rows = static_cast<int>(std::tan(camera.half_height_rad) / kCell);
  const int columns = 2 * half_columns, rows = 2 * half_rows;
  const int first_column = static_cast<int>(std::ceil(frame.baseline_m / kLeastDepth / kCell));
  std::vector<std::optional<SurfaceCell>> cells(idx(columns) * idx(rows));
  for (int row = 0; row < rows; ++row) {
    for (int column = first_column; column < columns; ++column) {
      cells[idx(row * columns + column)] =
          cell_at(kCell * Eigen::Vector2d(column - half_columns, row - half_rows), rays);
    }
  }
  for (const StereoFeature& feature : frame.features) {
    const int column = static_cast<int>(std::floor(feature.left.x() / kCell)) + half_columns;
    const int row = static_cast<int>(std::floor(feature.left.y() / kCell)) + half_rows;
    if (column < 0 || column >= columns || row < 0 || row >= rows) continue;
    auto& cell = cells[idx(row * columns + column)];
    if (!cell) continue;
    if (feature.has_right && lies_on_surface(feature, frame, pose, rays)) {
      cell->has_landmark = true;
    } else {
      cell.reset();
    }
  }
  std::vector<SurfaceCell> seen;
  for (const auto& cell : cells) {
    if (cell) seen.push_back(*cell);
  }
  return seen;
}

}  // namespace tern
