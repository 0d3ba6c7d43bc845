#include "planner/heading/unseen_term.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/heading/path_term.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Returns the distance from p along a horizontal direction to a box, at most `most`, m.
double reach_to(const Box& box, const Vec3& p, const Vec3& way, double most) {
  double in = 0.0, out = most;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0.0) {
      if (p[axis] < box.min()[axis] || p[axis] > box.max()[axis]) return most;
      continue;
    }
    const double a = (box.min()[axis] - p[axis]) / way[axis], b = (box.max()[axis] - p[axis]) / way[axis];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return in <= out ? in : most;
}

}  // namespace

double UnseenTerm::sight(const LookInstant& now, const Vec3& way, const std::vector<Box>& near) const {
  double reach = UnseenField::kFarthest;
  for (const Box& box : near) reach = reach_to(box, now.p, way, reach);
  return reach;
}

void UnseenTerm::look(const LookInstant& now, std::vector<LookTarget>& targets) const {
  const double soon_s = kSightAhead + stop_time(now.v.head<2>().norm(), limits_);
  const double w = field_.max_speed(), edge = 0.5 * field_.grid().cell;
  const auto urgency = [&](double x) { return std::exp(-(x - radius_) / (w * soon_s)); };
  const Vec3 around(UnseenField::kFarthest, UnseenField::kFarthest, 0.0);
  std::vector<Box> near;
  for (const Box& box : boxes_) {
    if (!box.intersects(Box(now.p - around, now.p + around))) continue;
    const double room = (now.p - box.min().cwiseMax(now.p.cwiseMin(box.max()))).head<2>().norm() - radius_;
    const double before = std::clamp(room, 0.0, kUnseenBefore);
    near.emplace_back(box.min() - Vec3(before, before, 0.0), box.max() + Vec3(before, before, 0.0));
  }
  for (int k = 0; k < kUnseenBearings; ++k) {
    const double bearing = 2.0 * std::numbers::pi * k / kUnseenBearings;
    const Vec3 way(std::cos(bearing), std::sin(bearing), 0.0);
    const double end = sight(now, way, near);
    double taken = 0.0;
    for (double x = radius_; x < end;) {
      const double gap = field_.distance((now.p + x * way).head<2>());
      const double next = std::min(end, x + std::max(gap, edge));
      if (gap <= edge) taken += urgency(x) - urgency(next);
      x = next;
    }
    if (taken > 0.0) targets.push_back({bearing, w * taken * 2.0 * std::numbers::pi / kUnseenBearings});
  }
}

}  // namespace tern
