#include "core/drawing/predicted_hulls.h"

#include <algorithm>
#include <tuple>

#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"
#include "core/world/track_sweep.h"

namespace tern {
namespace {

Points sweep(const Track& track, UTime from, UTime to) {
  std::vector<CentredBox> boxes;
  add_sweep(boxes, track, {}, Vec3::Zero(), from, 0.0, (to - from).seconds());
  Points corners(3, 8 * static_cast<Eigen::Index>(boxes.size()));
  for (Eigen::Index k = 0; k < corners.cols() / 8; ++k) {
    const CentredBox& box = boxes[idx(k)];
    corners.middleCols<8>(8 * k) = box_corners(box_around(box.centre, box.half));
  }
  return hull_vertices(corners);
}

struct Candidate {
  double distance = 0.0;
  const Track* track = nullptr;
  int interval = 0;
};

}  // namespace

PredictedHulls predicted_hulls(const TrackSet& tracks, const TimedSpline& plan, Duration ahead, double reach,
                               int most) {
  const ClampedSpline spline = plan.spline();
  std::vector<Candidate> candidates;
  for (int j = 0; j < spline.intervals() && plan.interval * j < ahead; ++j) {
    const Box curve = spline.position_bounds(j);
    const UTime from = plan.start + plan.interval * j;
    for (const Track& track : tracks.tracks) {
      if (track.kind == TrackKind::Static) continue;
      const Box box = track.bounds(from, from + plan.interval);
      const double distance = curve.exteriorDistance(box);
      if (distance <= reach) candidates.push_back({distance, &track, j});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.track->id, a.interval) < std::tie(b.distance, b.track->id, b.interval);
  });
  PredictedHulls result;
  const std::size_t made = std::min(candidates.size(), static_cast<std::size_t>(std::max(most, 0)));
  result.left_out = static_cast<int>(candidates.size() - made);
  for (std::size_t k = 0; k < made; ++k) {
    const UTime from = plan.start + plan.interval * candidates[k].interval;
    result.hulls.push_back(
        {candidates[k].track->id, candidates[k].interval, sweep(*candidates[k].track, from, from + plan.interval)});
  }
  return result;
}

}  // namespace tern
