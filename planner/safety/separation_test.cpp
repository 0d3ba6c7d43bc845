#include "planner/safety/separation_test.h"

#include <array>
#include <optional>

#include "core/geometry/separation.h"
#include "core/splines/minvo.h"
#include "core/splines/piecewise_cubic.h"

namespace tern {
namespace {

constexpr int kMostParts = 4;

Box box_of(const Points4& points) { return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()}; }

class PairTest {
 public:
  PairTest(SweptObstacles& obstacles, int interval, const PowerCubic& power, PairCounts& counts,
           std::vector<CertificatePlane>* planes, double reach, HullForm form)
      : obstacles_(obstacles),
        interval_(interval),
        power_(power),
        counts_(counts),
        planes_(planes),
        reach_(Vec3::Constant(reach)),
        form_(form) {}

  /// One pair of obstacle and part; splits the part in time where one plane does not do.
  bool separated(const SweptObstacles::Candidate& candidate, const Points4& points, int part, int parts) {
    if (const auto found = plane_of(candidate, points, part, parts)) {
      if (planes_ != nullptr) {
        planes_->push_back({obstacles_.obstacle(candidate).id, static_cast<std::int16_t>(interval_),
                            static_cast<std::int8_t>(part), static_cast<std::int8_t>(parts), found->plane});
      }
      return true;
    }
    if (parts == kMostParts) return false;
    for (int half = 0; half < 2; ++half) {
      const int sub = 2 * part + half;
      const double width = 1.0 / (2 * parts);
      const Points4 sub_points = form_.points(interval_, power_, sub * width, (sub + 1) * width);
      if (!grown(box_of(sub_points), reach_).intersects(obstacles_.part_box(interval_, candidate, sub, 2 * parts))) {
        ++counts_.by_box;
        continue;
      }
      if (!separated(candidate, sub_points, sub, 2 * parts)) return false;
    }
    return true;
  }

 private:
  /// For a certificate from the hull, which is only made where there is a plane; for a solver from the sweep.
  std::optional<Separation> plane_of(const SweptObstacles::Candidate& candidate, const Points4& points, int part,
                                     int parts) {
    ++counts_.by_plane;
    if (reach_.x() > 0.0) return obstacles_.plane(interval_, candidate, points, part, parts);
    if (!obstacles_.is_apart(interval_, candidate, points, part, parts)) return std::nullopt;
    return separate(obstacles_.hull(interval_, candidate, part, parts), points, obstacles_.body().radius);
  }

  SweptObstacles& obstacles_;
  int interval_;
  const PowerCubic& power_;
  PairCounts& counts_;
  std::vector<CertificatePlane>* planes_;
  Vec3 reach_;
  HullForm form_;
};

/// A curve over one interval: the hull points of its parts, and its points at the quarters, when first needed.
class Curve {
 public:
  Curve(const PowerCubic& power, const Points4& points, int interval, HullForm form)
      : power_(power), interval_(interval), form_(form) {
    parts_[0] = {points, box_of(points)};
    made_[0] = true;
  }
  struct Part {
    Points4 points;
    Box box;
  };
  const Part& part(int part, int parts) {
    const auto at = static_cast<std::size_t>(parts - 1 + part);
    if (!made_[at]) {
      const double width = 1.0 / parts;
      const Points4 points = form_.points(interval_, power_, part * width, (part + 1) * width);
      parts_[at] = {points, box_of(points)};
      made_[at] = true;
    }
    return parts_[at];
  }
  Vec3 at_quarter(int k) {
    const auto at = static_cast<std::size_t>(k);
    if (!has_quarter_[at]) quarters_[at] = sample_cubic(power_, 0.25 * k).p;
    has_quarter_[at] = true;
    return quarters_[at];
  }

 private:
  const PowerCubic& power_;
  int interval_;
  HullForm form_;
  std::array<Part, 7> parts_;
  std::array<Vec3, 5> quarters_;
  std::array<bool, 7> made_{};
  std::array<bool, 5> has_quarter_{};
};

/// Yes or no for one curve.
class ClearTest {
 public:
  ClearTest(SweptObstacles& obstacles, int interval, Curve& curve, PairCounts& counts)
      : obstacles_(obstacles), interval_(interval), curve_(curve), counts_(counts) {}

  bool clear_of(const SweptObstacles::Candidate& candidate) {
    if (!curve_.part(0, 1).box.intersects(candidate.box)) {
      ++counts_.by_box;
      return true;
    }
    return !touches(candidate) && part_clear(candidate, 0, 1);
  }

 private:
  /// At one of five instants: most of what blocks is found so.
  bool touches(const SweptObstacles::Candidate& candidate) {
    if (!obstacles_.body_is_round_or_box()) return false;
    const double radius2 = obstacles_.body().radius * obstacles_.body().radius;
    for (int k = 0; k < 5; ++k) {
      const CentredBox& box = obstacles_.at_quarter(interval_, candidate, k);
      const Vec3 outside = ((curve_.at_quarter(k) - box.centre).cwiseAbs() - box.half).cwiseMax(0.0);
      if (outside.squaredNorm() > radius2) continue;
      ++counts_.by_instant;
      return true;
    }
    return false;
  }

  bool part_clear(const SweptObstacles::Candidate& candidate, int part, int parts) {
    bool by_cache = false;
    const bool apart =
        obstacles_.is_apart(interval_, candidate, curve_.part(part, parts).points, part, parts, &by_cache);
    ++(by_cache ? counts_.by_cache : counts_.by_plane);
    if (apart) return true;
    if (parts == kMostParts) return false;
    for (int sub = 2 * part; sub < 2 * part + 2; ++sub) {
      if (!curve_.part(sub, 2 * parts).box.intersects(obstacles_.part_box(interval_, candidate, sub, 2 * parts))) {
        ++counts_.by_box;
      } else if (!part_clear(candidate, sub, 2 * parts)) {
        return false;
      }
    }
    return true;
  }

  SweptObstacles& obstacles_;
  int interval_;
  Curve& curve_;
  PairCounts& counts_;
};

}  // namespace

Points4 minvo_of(const PowerCubic& power, double u0, double u1) {
  if (u0 == 0.0 && u1 == 1.0) return power * minvo_inverse_3();
  return reparametrized(power, u0, u1) * minvo_inverse_3();
}

Separated separate_interval(SweptObstacles& obstacles, int interval, const PowerCubic& power, PairCounts& counts,
                            std::vector<CertificatePlane>* planes, double reach, HullForm form) {
  const Points4 points = form.points(interval, power, 0.0, 1.0);
  const Box box = grown(box_of(points), Vec3::Constant(reach));
  PairTest test(obstacles, interval, power, counts, planes, reach, form);
  for (const SweptObstacles::Candidate& candidate : obstacles.candidates(interval)) {
    if (!box.intersects(candidate.box)) {
      ++counts.by_box;
      continue;
    }
    if (!test.separated(candidate, points, 0, 1)) return {false, obstacles.obstacle(candidate).id};
  }
  return {};
}

bool is_clear(SweptObstacles& obstacles, int interval, const PowerCubic& power, const Points4& points,
              PairCounts& counts, HullForm form) {
  Curve curve(power, points, interval, form);
  ClearTest test(obstacles, interval, curve, counts);
  const auto& candidates = obstacles.candidates(interval);
  int& last = obstacles.last_blocker(interval);
  if (last >= 0 && !test.clear_of(candidates[static_cast<std::size_t>(last)])) return false;
  for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
    if (k == last || test.clear_of(candidates[static_cast<std::size_t>(k)])) continue;
    last = k;
    return false;
  }
  return true;
}

ClearTime clear_time_at(SweptObstacles& obstacles, int first, const Vec3& p, PairCounts& counts) {
  for (int k = first; k < obstacles.intervals(); ++k) {
    for (const SweptObstacles::Candidate& candidate : obstacles.candidates(k)) {
      if (!candidate.box.contains(p)) {
        ++counts.by_box;
        continue;
      }
      bool by_cache = false;
      const bool apart = obstacles.is_apart(k, candidate, p, 0, 1, &by_cache);
      ++(by_cache ? counts.by_cache : counts.by_plane);
      if (!apart) return {obstacles.time(k) - obstacles.time(first), &obstacles.obstacle(candidate)};
    }
  }
  return {obstacles.time(obstacles.intervals()) - obstacles.time(first), nullptr};
}

}  // namespace tern
