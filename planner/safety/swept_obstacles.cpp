#include "planner/safety/swept_obstacles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"

namespace tern {
namespace {

constexpr int kHullsPerSlot = 1 + 2 + 4;

bool is_box(const Points& vertices) {
  if (vertices.cols() == 1) return vertices.isZero(0.0);
  if (vertices.cols() != 8) return false;
  const Vec3 h = vertices.cwiseAbs().rowwise().maxCoeff();
  const Eigen::Matrix<double, 3, 8> corners = box_corners(Box(-h, h));
  int found = 0;
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 8; ++i) found += vertices.col(i) == corners.col(k) ? 1 : 0;
  }
  return found == 8;
}

/// Collects the corners of boxes.
struct CornerCloud {
  std::vector<double> xyz;

  void add(const Vec3& centre, const Vec3& half) {
    const Eigen::Matrix<double, 3, 8> corners = box_corners(box_around(centre, half));
    xyz.insert(xyz.end(), corners.data(), corners.data() + corners.size());
  }
  [[nodiscard]] Points points() const {
    return Eigen::Map<const Points>(xyz.data(), 3, static_cast<Eigen::Index>(xyz.size() / 3));
  }
};

/// cloud ⊕ (−vertices).
Points minkowski_difference(const Points& cloud, const Points& vertices) {
  Points sum(3, cloud.cols() * vertices.cols());
  for (Eigen::Index v = 0; v < vertices.cols(); ++v) {
    sum.middleCols(v * cloud.cols(), cloud.cols()) = cloud.colwise() - vertices.col(v);
  }
  return sum;
}

/// Boxes along the part of a piece between local times a and b; half-extents grow by the sampling error β.
void add_piece(CornerCloud& cloud, const PowerCubic& cubic, double a, double b, const Vec3& half) {
  const Vec3 acceleration = max_abs_acceleration(cubic, a, b);
  const double span = b - a;
  const int n = std::max(1, static_cast<int>(std::ceil(span * std::sqrt(acceleration.maxCoeff() / (8.0 * kBetaMax)))));
  const double h = span / n;
  const Vec3 grown_half = half + acceleration * (h * h / 8.0);
  for (int k = 0; k <= n; ++k) cloud.add(sample_cubic(cubic, a + h * k).p, grown_half);
}

/// The sweep of a track (with its α) over [from, to] seconds after origin; outside its pieces a box that grows.
CornerCloud sweep(const Track& track, double alpha_scale, const Vec3& body_half, UTime origin, double from, double to) {
  CornerCloud cloud;
  const double start = (track.motion.start - origin).seconds();
  double piece_from = start;
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    const double piece_to = piece_from + piece.duration.seconds();
    const double a = std::max(from, piece_from);
    const double b = std::min(to, piece_to);
    if (a <= b) {
      const Vec3 half = track.half_extents + alpha_scale * track.alpha[k] + body_half;
      add_piece(cloud, piece.coefficients, a - piece_from, b - piece_from, half);
    }
    piece_from = piece_to;
  }
  const auto add_growing = [&](double seconds, const Vec3& p, const Vec3& alpha) {
    cloud.add(p, track.half_extents + alpha_scale * alpha + body_half + Vec3::Constant(track.top_speed * seconds));
  };
  if (to > piece_from) {
    const CubicPiece& last = track.motion.pieces.back();
    add_growing(to - piece_from, sample_cubic(last.coefficients, last.duration.seconds()).p, track.alpha.back());
  }
  if (from < start) add_growing(start - from, track.motion.pieces.front().coefficients.col(3), track.alpha.front());
  return cloud;
}

Box sweep_box(const PlanningObstacle& obstacle, const Vec3& body_half, UTime origin, double from, double to) {
  if (obstacle.track == nullptr) return grown(obstacle.box, body_half);
  const auto us = [](double s) { return Duration{static_cast<std::int64_t>(std::floor(s * 1e6))}; };
  const Box box = obstacle.track->bounds(origin + us(from), origin + us(to) + Duration{1});
  return grown(box, body_half + Vec3::Constant(kBetaMax));
}

}  // namespace

SweptObstacles::SweptObstacles(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                               std::vector<double> times, const Box& region)
    : obstacles_(obstacles),
      body_(body),
      body_is_box_(is_box(body.vertices)),
      origin_(origin),
      times_(std::move(times)) {
  if (times_.size() < 2) throw std::invalid_argument("SweptObstacles: fewer than two times");
  candidates_.resize(static_cast<std::size_t>(intervals()));
  const Vec3 half = body_.half_extents();
  int slots = 0;
  for (std::size_t i = 0; i < obstacles_.size(); ++i) {
    const PlanningObstacle& o = obstacles_[i];
    if (!grown(o.box, half + Vec3::Constant(kBetaMax)).intersects(region)) continue;
    const int shared_slot = o.moves() ? -1 : slots++;
    for (int k = 0; k < intervals(); ++k) {
      const Box box = sweep_box(o, half, origin_, time(k), time(k + 1));
      if (!box.intersects(region)) continue;
      const int slot = o.moves() ? slots++ : shared_slot;
      candidates_[static_cast<std::size_t>(k)].push_back({box, static_cast<int>(i), slot});
    }
  }
  hulls_.resize(static_cast<std::size_t>(slots) * kHullsPerSlot);
}

SweptObstacles::Span SweptObstacles::span(int interval, int part, int parts) const {
  const double from = time(interval);
  const double to = time(interval + 1);
  const double step = (to - from) / parts;
  return {from + part * step, part + 1 == parts ? to : from + (part + 1) * step};
}

Box SweptObstacles::part_box(int interval, const Candidate& candidate, int part, int parts) const {
  const Span s = span(interval, part, parts);
  return sweep_box(obstacle(candidate), body_.half_extents(), origin_, s.from, s.to);
}

const Points& SweptObstacles::hull(int interval, const Candidate& candidate, int part, int parts) {
  const PlanningObstacle& o = obstacle(candidate);
  const int within = o.moves() ? parts - 1 + part : 0;
  Points& cached = hulls_[static_cast<std::size_t>(candidate.slot * kHullsPerSlot + within)];
  if (cached.cols() == 0) {
    cached = make_hull(o, span(interval, part, parts));
    ++hulls_made_;
  }
  return cached;
}

Points SweptObstacles::make_hull(const PlanningObstacle& o, Span s) const {
  const Vec3 box_half = body_is_box_ ? Vec3(body_.vertices.cwiseAbs().rowwise().maxCoeff()) : Vec3(Vec3::Zero());
  CornerCloud cloud;
  if (o.track == nullptr) {
    cloud.add(o.box.center(), 0.5 * o.box.sizes() + box_half);
  } else if (!o.moves()) {
    const Vec3 p = o.track->motion.pieces.front().coefficients.col(3);
    cloud.add(p, o.track->half_extents + o.alpha_scale * o.track->alpha.front() + box_half);
  } else {
    cloud = sweep(*o.track, o.alpha_scale, box_half, origin_, s.from, s.to);
  }
  if (!body_is_box_) return hull_vertices(minkowski_difference(cloud.points(), body_.vertices));
  return o.moves() ? hull_vertices(cloud.points()) : cloud.points();
}

}  // namespace tern
