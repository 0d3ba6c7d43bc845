#include "planner/safety/swept_obstacles.h"

#include <cmath>
#include <stdexcept>

#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"

namespace tern {
namespace {

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

/// Returns cloud ⊕ (−vertices).
Points minkowski_difference(const Points& cloud, const Points& vertices) {
  Points sum(3, cloud.cols() * vertices.cols());
  for (Eigen::Index v = 0; v < vertices.cols(); ++v) {
    sum.middleCols(v * cloud.cols(), cloud.cols()) = cloud.colwise() - vertices.col(v);
  }
  return sum;
}

/// Returns the track's box at one instant, as add_sweep() makes it but without β.
CentredBox box_at(const Track& track, const AlphaShare& count, const Vec3& body_half, UTime origin, double at) {
  double piece_from = (track.motion.start - origin).seconds();
  const auto grown_half = [&](const Vec3& alpha, double seconds) -> Vec3 {
    return track.half_extents + alpha + body_half + Vec3::Constant(track.top_speed * seconds);
  };
  if (at < piece_from) {
    return {track.motion.pieces.front().coefficients.col(3), grown_half(count.of(track, 0), piece_from - at)};
  }
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    const double piece_to = piece_from + piece.duration.seconds();
    if (at <= piece_to) return {position_of(piece.coefficients, at - piece_from), grown_half(count.of(track, k), 0.0)};
    piece_from = piece_to;
  }
  const CubicPiece& last = track.motion.pieces.back();
  return {position_of(last.coefficients, last.duration.seconds()),
          grown_half(count.of(track, track.alpha.size() - 1), at - piece_from)};
}

/// An upper bound of the rounding between the box of a piece and that of a part of it, m.
constexpr double kRoughSlack = 1e-6;

UTimeSpan microseconds(UTime origin, double from, double to) {
  const auto us = [](double s) { return Duration{static_cast<std::int64_t>(std::floor(s * 1e6))}; };
  return {origin + us(from), origin + us(to) + Duration{1}};
}

Box sweep_box(const PlanningObstacle& obstacle, const Vec3& body_half, UTime origin, double from, double to) {
  if (obstacle.track == nullptr) return grown(obstacle.map_box(obstacle.alpha.scale), body_half);
  const UTimeSpan t = microseconds(origin, from, to);
  const Box box = bounds_at(*obstacle.track, t.from, t.to, obstacle.alpha, {0, obstacle.track->motion.start});
  return grown(box, body_half + Vec3::Constant(kBetaMax));
}

/// Returns whether boxes of the obstacle's pieces are known for the whole span.
bool is_within_pieces(const PlanningObstacle& o, const UTimeSpan& t) {
  return o.boxes != nullptr && t.from >= o.track->motion.start && t.to <= o.boxes->end;
}

/// A track's pieces in a series of time spans, in order of their starts. Pieces that have ended are skipped for good.
class PieceWalk {
 public:
  explicit PieceWalk(const PlanningObstacle& o) : obstacle_(o), first_{0, o.track->motion.start} {}

  void advance_to(const UTimeSpan& t) {
    t_ = t;
    const auto& pieces = obstacle_.track->motion.pieces;
    while (first_.index + 1 < pieces.size() && first_.start + pieces[first_.index].duration < t.from) {
      first_.start = first_.start + pieces[first_.index++].duration;
    }
  }
  /// Returns whether the boxes of the pieces prove that the track stays out of `near`.
  [[nodiscard]] bool is_surely_out_of(const Box& near) const {
    const auto& pieces = obstacle_.track->motion.pieces;
    if (!is_within_pieces(obstacle_, t_)) return false;
    Box box;
    UTime start = first_.start;
    for (std::size_t k = first_.index; k < pieces.size() && start <= t_.to; start = start + pieces[k++].duration) {
      box.extend(obstacle_.boxes->pieces[k]);
    }
    return !box.intersects(near);
  }
  [[nodiscard]] Box bounds() const { return bounds_at(*obstacle_.track, t_.from, t_.to, obstacle_.alpha, first_); }

 private:
  const PlanningObstacle& obstacle_;
  UTimeSpan t_;
  PiecewiseCubic::Located first_;
};

}  // namespace

void SweptObstacles::assign(const std::vector<PlanningObstacle>& obstacles, const Body& body, UTime origin,
                            std::span<const double> times, const Box& region) {
  if (times.size() < 2) throw std::invalid_argument("SweptObstacles: fewer than two times");
  obstacles_ = &obstacles;
  body_ = body;
  body_is_box_ = is_box(body.vertices);
  body_half_ = body.half_extents();
  box_half_ = body_is_box_ ? Vec3(body.vertices.cwiseAbs().rowwise().maxCoeff()) : Vec3(Vec3::Zero());
  origin_ = origin;
  times_.assign(times.begin(), times.end());
  const auto n = static_cast<std::size_t>(intervals());
  spans_.resize(n);
  for (std::size_t k = 0; k < n; ++k) spans_[k] = microseconds(origin, times[k], times[k + 1]);
  if (neighbours_.size() < n) neighbours_.resize(n);
  for (auto& list : neighbours_) list.clear();
  slots_ = 0;
  out_of_reach_ = static_cast<std::int64_t>(obstacles.size() * n);
  const Vec3 slack = body_half_ + Vec3::Constant(kBetaMax);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!grown(obstacles[i].box, slack).intersects(region)) continue;
    if (obstacles[i].moves()) {
      add_track(static_cast<int>(i), region);
    } else {
      add_static(static_cast<int>(i), region);
    }
  }
  for (std::size_t k = 0; k < n; ++k) out_of_reach_ -= static_cast<std::int64_t>(neighbours_[k].size());
}

void SweptObstacles::add_static(int index, const Box& region) {
  const PlanningObstacle& o = (*obstacles_)[idx(index)];
  const Box box = sweep_box(o, body_half_, origin_, time(0), time(1));
  if (!box.intersects(region)) return;
  const int slot = slots_++;
  for (int k = 0; k < intervals(); ++k) neighbours_[idx(k)].push_back({box, index, slot});
}

void SweptObstacles::add_track(int index, const Box& region) {
  const PlanningObstacle& o = (*obstacles_)[idx(index)];
  const Vec3 slack = body_half_ + Vec3::Constant(kBetaMax);
  const Box near = grown(region, slack + Vec3::Constant(kRoughSlack));
  const bool stays_within_pieces = is_within_pieces(o, {spans_.front().from, spans_.back().to});
  if (stays_within_pieces && !o.boxes->whole.intersects(near)) return;
  PieceWalk walk(o);
  for (int k = 0; k < intervals(); ++k) {
    walk.advance_to(spans_[idx(k)]);
    if (walk.is_surely_out_of(near)) continue;
    const Box box = grown(walk.bounds(), slack);
    if (!box.intersects(region)) continue;
    neighbours_[idx(k)].push_back({box, index, slots_++});
  }
}

SweptObstacles::Span SweptObstacles::span(const TimePart& part) const {
  const double from = time(part.interval);
  const double to = time(part.interval + 1);
  const double step = (to - from) / part.of;
  return {from + part.index * step, part.is_last() ? to : from + (part.index + 1) * step};
}

Box SweptObstacles::part_box(const Neighbour& neighbour, const TimePart& part) const {
  const Span s = span(part);
  return sweep_box(obstacle(neighbour), body_half_, origin_, s.from, s.to);
}

CentredBox SweptObstacles::box_at_rest(const PlanningObstacle& o) const {
  if (o.track == nullptr) {
    const Box box = o.map_box(o.alpha.scale);
    return {box.center(), 0.5 * box.sizes() + box_half_};
  }
  const Vec3 p = o.track->motion.pieces.front().coefficients.col(3);
  return {p, o.track->half_extents + o.alpha.of(*o.track, 0) + box_half_};
}

void SweptObstacles::append_sweep(std::vector<CentredBox>& boxes, const Neighbour& neighbour,
                                  const TimePart& part) const {
  const PlanningObstacle& o = obstacle(neighbour);
  if (!o.moves()) {
    boxes.push_back(box_at_rest(o));
    return;
  }
  const Span s = span(part);
  add_sweep(boxes, *o.track, o.alpha, box_half_, origin_, s.from, s.to);
}

CentredBox SweptObstacles::box_at_quarter(int interval, const Neighbour& neighbour, int k) const {
  const PlanningObstacle& o = obstacle(neighbour);
  if (!o.moves()) return box_at_rest(o);
  const double from = time(interval);
  const double step = (time(interval + 1) - from) / (kQuarters - 1);
  return box_at(*o.track, o.alpha, box_half_, origin_, from + k * step);
}

Points SweptObstacles::hull(const Neighbour& neighbour, std::span<const CentredBox> boxes) const {
  if (!hull_is_made_by_cgal(neighbour)) return box_corners(box_around(boxes[0].centre, boxes[0].half));
  Points corners(3, 8 * static_cast<Eigen::Index>(boxes.size()));
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    corners.middleCols<8>(8 * static_cast<Eigen::Index>(k)) = box_corners(box_around(boxes[k].centre, boxes[k].half));
  }
  return hull_vertices(body_is_box_ ? corners : minkowski_difference(corners, body_.vertices));
}

}  // namespace tern
