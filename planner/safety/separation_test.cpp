#include "planner/safety/separation_test.h"

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
    const auto found = separate(obstacles_.hull(interval_, candidate, part, parts), points, obstacles_.body().radius);
    ++counts_.by_plane;
    if (found) {
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
  SweptObstacles& obstacles_;
  int interval_;
  const PowerCubic& power_;
  PairCounts& counts_;
  std::vector<CertificatePlane>* planes_;
  Vec3 reach_;
  HullForm form_;
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

double clear_time_at(SweptObstacles& obstacles, int first, const Vec3& p, PairCounts& counts) {
  const Points point = p;
  for (int k = first; k < obstacles.intervals(); ++k) {
    for (const SweptObstacles::Candidate& candidate : obstacles.candidates(k)) {
      if (!candidate.box.contains(p)) {
        ++counts.by_box;
        continue;
      }
      ++counts.by_plane;
      if (!separate(obstacles.hull(k, candidate, 0, 1), point, obstacles.body().radius)) {
        return obstacles.time(k) - obstacles.time(first);
      }
    }
  }
  return obstacles.time(obstacles.intervals()) - obstacles.time(first);
}

}  // namespace tern
