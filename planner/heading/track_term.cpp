#include "planner/heading/track_term.h"

#include <algorithm>
#include <cmath>

#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// The centre of the box that contains track and α at t, W.
Vec3 centre_at(const Track& track, UTime t) { return track.bounds(t, t).center(); }

double worth_of(const Track& track, const TimedSpline& trajectory, const ClampedSpline& spline, UTime from) {
  double worth = 0.0;
  for (int k = 0; k < kTrackSteps; ++k) {
    const Duration later = kTrackStep * k;
    const UTime t = from + later;
    const Vec3 p = spline.sample(std::max(0.0, (t - trajectory.start).seconds())).p;
    const Box box = track.bounds(t, t);
    const Vec3 alpha = 0.5 * box.sizes() - track.half_extents;
    const double mean = std::min(0.5 * (alpha.x() + alpha.y()), kAlphaCap);
    const double gap = box.exteriorDistance(p);
    worth = std::max(worth, mean * std::exp(-gap / kTrackReach - later.seconds() / kTrackSoon));
  }
  return worth;
}

}  // namespace

TrackTerm::TrackTerm(const std::vector<Track>& tracks, const TimedSpline& trajectory, UTime from) {
  const ClampedSpline spline = trajectory.spline();
  for (const Track& track : tracks) {
    if (track.kind != TrackKind::Estimated) continue;
    seen_.push_back({&track, worth_of(track, trajectory, spline, from)});
  }
  std::ranges::stable_sort(seen_, [](const Worth& a, const Worth& b) { return a.worth > b.worth; });
  seen_.resize(std::min(seen_.size(), kTracksSeen));
}

void TrackTerm::look(const LookInstant& now, std::vector<LookTarget>& targets) const {
  for (const Worth& w : seen_) {
    const Vec3 way = centre_at(*w.track, now.at) - now.p;
    if (way.head<2>().norm() < kNearestPlace) continue;
    targets.push_back({std::atan2(way.y(), way.x()), w.worth});
  }
}

}  // namespace tern
