#include "viewer/bridge/predicted_hulls.h"

#include <algorithm>
#include <tuple>

#include "core/geometry/box.h"
#include "core/geometry/convex_hull.h"

namespace tern {
namespace {

/// Per piece and interval: enough for the eye; β keeps the hull on the safe side.
constexpr int kSamples = 4;

struct Cloud {
  std::vector<double> xyz;

  void add(const Vec3& centre, const Vec3& half) {
    const auto corners = box_corners(box_around(centre, half));
    xyz.insert(xyz.end(), corners.data(), corners.data() + corners.size());
  }
};

Points sweep(const Track& track, UTime from, UTime to) {
  Cloud cloud;
  UTime piece_start = track.motion.start;
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    const UTime a = std::max(from, piece_start);
    const UTime b = std::min(to, piece_start + piece.duration);
    if (a <= b) {
      const double t0 = (a - piece_start).seconds();
      const double h = ((b - piece_start).seconds() - t0) / kSamples;
      const Vec3 beta = max_abs_acceleration(piece.coefficients, t0, t0 + kSamples * h) * (h * h / 8.0);
      const Vec3 half = track.half_extents + track.alpha[k] + beta;
      for (int i = 0; i <= kSamples; ++i) cloud.add(sample_cubic(piece.coefficients, t0 + i * h).p, half);
    }
    piece_start = piece_start + piece.duration;
  }
  const auto add_box = [&](const Box& box) { cloud.add(box.center(), 0.5 * box.sizes()); };
  if (to > piece_start) add_box(track.bounds(std::max(from, piece_start), to));
  if (from < track.motion.start) add_box(track.bounds(from, std::min(to, track.motion.start)));
  return hull_vertices(Eigen::Map<const Points>(cloud.xyz.data(), 3, static_cast<Eigen::Index>(cloud.xyz.size() / 3)));
}

struct Candidate {
  double distance = 0.0;
  const Track* track = nullptr;
  int interval = 0;
};

}  // namespace

PredictedHulls predicted_hulls(const TrackSet& tracks, const TimedSpline& plan, double reach, int most) {
  const ClampedSpline spline = plan.spline();
  std::vector<Candidate> candidates;
  for (int j = 0; j < spline.intervals(); ++j) {
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
