#include "planner/safety/interval_separation.h"

#include <array>
#include <optional>

#include "core/geometry/separation.h"
#include "core/splines/piecewise_cubic.h"

namespace tern {
namespace {

Box box_of(const Points4& points) { return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()}; }

using Neighbour = SweptObstacles::Neighbour;

/// Returns whether the part of the curve is farther than the body's radius (and kTouchingTolerance) from the sweep. Up
/// to rounding this is the answer of separate() for the hull and the points.
/// @param points    hull points of the part, or one point at rest
/// @param by_cache  receives whether the direction that last separated the part did so again
bool is_separated(SeparationCache& cache, const Neighbour& neighbour, const Eigen::Ref<const Points>& points,
                  const TimePart& part, bool& by_cache) {
  const auto [boxes, direction] = cache.sweep(neighbour, part);
  const bool known = !direction.isZero(0.0);
  if (!known) direction = boxes[0].centre - points.col(0);
  if (direction.isZero(0.0)) direction = Vec3::UnitX();
  const Vec3 before = direction;
  const double radius = cache.obstacles().body().radius;
  const IsSeparated answer = is_separated(boxes, points, cache.obstacles().vertices_to_add(), radius, direction);
  by_cache = known && answer == IsSeparated::Yes && direction == before;
  if (answer != IsSeparated::Doubt) return answer == IsSeparated::Yes;
  return separate(cache.hull(neighbour, part), points, radius).has_value();
}

bool is_separated(SeparationCache& cache, const Neighbour& neighbour, const Eigen::Ref<const Points>& points,
                  const TimePart& part, PairCounts& counts) {
  bool by_cache = false;
  const bool separated = is_separated(cache, neighbour, points, part, by_cache);
  ++(by_cache ? counts.by_cache : counts.by_plane);
  return separated;
}

/// Returns a plane for a certificate, made by separate() from the hull. The hull is made only if a plane of the sweep
/// exists, which differs from this one by rounding. Anyone with hull and points can compute it again, bit for bit.
std::optional<Separation> certificate_plane(SeparationCache& cache, const Neighbour& neighbour, const Points4& points,
                                            const TimePart& part) {
  bool by_cache = false;
  if (!is_separated(cache, neighbour, points, part, by_cache)) return std::nullopt;
  return separate(cache.hull(neighbour, part), points, cache.obstacles().body().radius);
}

/// Returns a plane for a solver. It is not published.
std::optional<Separation> solver_plane(SeparationCache& cache, const Neighbour& neighbour, const Points4& points,
                                       const TimePart& part) {
  return separate_sweep(cache.sweep(neighbour, part).boxes, points, cache.obstacles().vertices_to_add(),
                        cache.obstacles().body().radius);
}

/// Separates one interval of a curve from all obstacles; splits it in time if one plane is not enough.
struct Splitting {
  using PlaneMaker = std::optional<Separation> (*)(SeparationCache&, const Neighbour&, const Points4&, const TimePart&);

  SeparationCache& cache;
  const PowerCubic& power;
  HullForm form;
  double reach;  ///< boxes nearer than this count as overlapping, m
  PlaneMaker make_plane;
  PairCounts& counts;
  std::vector<CertificatePlane>& planes;

  Separated separate(int interval) {
    const TimePart whole{interval};
    const Points4 points = points_of(whole);
    const Box box = grown(box_of(points), Vec3::Constant(reach));
    for (const Neighbour& neighbour : cache.obstacles().neighbours(interval)) {
      if (!box.intersects(neighbour.box)) {
        ++counts.by_box;
      } else if (!has_planes(neighbour, points, whole)) {
        return {false, cache.obstacles().obstacle(neighbour).id};
      }
    }
    return {};
  }

 private:
  bool has_planes(const Neighbour& neighbour, const Points4& points, const TimePart& part) {
    ++counts.by_plane;
    if (const auto found = make_plane(cache, neighbour, points, part)) {
      planes.push_back({cache.obstacles().obstacle(neighbour).id, static_cast<std::int16_t>(part.interval),
                        static_cast<std::int8_t>(part.index), static_cast<std::int8_t>(part.of), found->plane});
      return true;
    }
    if (!part.has_halves()) return false;
    for (const TimePart& half : {part.half(0), part.half(1)}) {
      const Points4 of_half = points_of(half);
      if (!grown(box_of(of_half), Vec3::Constant(reach)).intersects(cache.part_box(neighbour, half))) {
        ++counts.by_box;
      } else if (!has_planes(neighbour, of_half, half)) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] Points4 points_of(const TimePart& part) const {
    return form.points(part.interval, power, part.u0(), part.u1());
  }
};

/// A curve over one interval. The hull points of its parts, and its points at the quarters, are made at first use.
class Curve {
 public:
  Curve(const PowerCubic& power, const Points4& points, HullForm form) : power_(power), form_(form) {
    parts_[0] = {points, box_of(points)};
    made_[0] = true;
  }
  struct Part {
    Points4 points;
    Box box;
  };
  const Part& part(const TimePart& part) {
    const std::size_t at = part.slot();
    if (!made_[at]) {
      const Points4 points = form_.points(part.interval, power_, part.u0(), part.u1());
      parts_[at] = {points, box_of(points)};
      made_[at] = true;
    }
    return parts_[at];
  }
  Vec3 at_quarter(int k) {
    const auto at = idx(k);
    if (!has_quarter_[at]) quarters_[at] = position_of(power_, 0.25 * k);
    has_quarter_[at] = true;
    return quarters_[at];
  }

 private:
  const PowerCubic& power_;
  HullForm form_;
  std::array<Part, TimePart::kSlots> parts_;
  std::array<Vec3, SweptObstacles::kQuarters> quarters_;
  std::array<bool, TimePart::kSlots> made_{};
  std::array<bool, SweptObstacles::kQuarters> has_quarter_{};
};

/// Decides for one curve whether it is separated.
class SeparationTest {
 public:
  SeparationTest(SeparationCache& cache, int interval, Curve& curve, PairCounts& counts)
      : cache_(cache), interval_(interval), curve_(curve), counts_(counts) {}

  bool is_separated_from(const Neighbour& neighbour) {
    const TimePart whole{interval_};
    if (!curve_.part(whole).box.intersects(neighbour.box)) {
      ++counts_.by_box;
      return true;
    }
    return !touches(neighbour) && is_part_separated(neighbour, whole);
  }

 private:
  /// Tests five instants: most collisions are found by them.
  bool touches(const Neighbour& neighbour) {
    if (!cache_.obstacles().body_is_round_or_box()) return false;
    const double radius2 = cache_.obstacles().body().radius * cache_.obstacles().body().radius;
    for (int k = 0; k < SweptObstacles::kQuarters; ++k) {
      const CentredBox& box = cache_.at_quarter(interval_, neighbour, k);
      const Vec3 outside = ((curve_.at_quarter(k) - box.centre).cwiseAbs() - box.half).cwiseMax(0.0);
      if (outside.squaredNorm() > radius2) continue;
      ++counts_.by_instant;
      return true;
    }
    return false;
  }

  bool is_part_separated(const Neighbour& neighbour, const TimePart& part) {
    if (is_separated(cache_, neighbour, curve_.part(part).points, part, counts_)) return true;
    if (!part.has_halves()) return false;
    for (const TimePart& half : {part.half(0), part.half(1)}) {
      if (!curve_.part(half).box.intersects(cache_.part_box(neighbour, half))) {
        ++counts_.by_box;
      } else if (!is_part_separated(neighbour, half)) {
        return false;
      }
    }
    return true;
  }

  SeparationCache& cache_;
  int interval_;
  Curve& curve_;
  PairCounts& counts_;
};

}  // namespace

Separated separate_interval(SeparationCache& cache, int interval, const PowerCubic& power, PairCounts& counts,
                            std::vector<CertificatePlane>& planes) {
  return Splitting{cache, power, HullForm{}, 0.0, &certificate_plane, counts, planes}.separate(interval);
}

void find_planes(SeparationCache& cache, const ClampedSpline& spline, HullBasis basis, double reach, PairCounts& counts,
                 std::vector<CertificatePlane>& planes) {
  for (int j = 0; j < spline.intervals(); ++j) {
    const PowerCubic power = spline.power(j);
    Splitting{cache, power, {basis, spline.intervals()}, reach, &solver_plane, counts, planes}.separate(j);
  }
}

bool is_separated(SeparationCache& cache, int interval, const PowerCubic& power, const Points4& points,
                  PairCounts& counts, HullForm form) {
  Curve curve(power, points, form);
  SeparationTest test(cache, interval, curve, counts);
  const auto& neighbours = cache.obstacles().neighbours(interval);
  int& last = cache.last_blocker(interval);
  if (last >= 0 && !test.is_separated_from(neighbours[idx(last)])) return false;
  for (int k = 0; k < static_cast<int>(neighbours.size()); ++k) {
    if (k == last || test.is_separated_from(neighbours[idx(k)])) continue;
    last = k;
    return false;
  }
  return true;
}

ClearTime clear_time_at(SeparationCache& cache, int first, const Vec3& p, PairCounts& counts) {
  for (int k = first; k < cache.obstacles().intervals(); ++k) {
    for (const Neighbour& neighbour : cache.obstacles().neighbours(k)) {
      if (!neighbour.box.contains(p)) {
        ++counts.by_box;
        continue;
      }
      if (!is_separated(cache, neighbour, p, {k}, counts)) {
        return {cache.obstacles().time(k) - cache.obstacles().time(first), &cache.obstacles().obstacle(neighbour)};
      }
    }
  }
  return {cache.obstacles().time(cache.obstacles().intervals()) - cache.obstacles().time(first), nullptr};
}

}  // namespace tern
