#include "simulator/worlds/drawn_recordings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "simulator/worlds/generators.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

constexpr int kMaxDraws = 10'000;
constexpr int kMaxRedraws = 1000;
constexpr double kStartSample = 0.01;    // s
constexpr double kMeetingSample = 0.05;  // s
// A copy's motion before world time 0, s: the part that the sensor sees, with points on both sides.
constexpr double kBefore = kLookAroundTime.seconds() + 0.5;

/// Position of a track at file time t_s, or nullopt if it is absent
std::optional<Vec3> place_at(const RecordedTrack& track, double t_s) {
  const auto& points = track.points;
  if (t_s < points.front().first || t_s > points.back().first) return std::nullopt;
  const auto next = std::ranges::upper_bound(points, t_s, {}, [](const auto& point) { return point.first; });
  if (next == points.end()) return points.back().second;
  const auto& [t0, p0] = *(next - 1);
  return Vec3(p0 + (next->second - p0) * ((t_s - t0) / (next->first - t0)));
}

double on_floor(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

bool meets(const RecordedTrack& track, double t_s, const UavSpec& uav) {
  const double bound = rest_to_rest_bound_s(uav.start, uav.goal, uav.limits);
  if (track.points.back().first < t_s || track.points.front().first > t_s + bound) return false;
  for (int k = 0; k * kMeetingSample <= bound; ++k) {
    const double t = k * kMeetingSample;
    const auto place = place_at(track, t_s + t);
    const Vec3 vehicle = uav.start + (uav.goal - uav.start) * (bound > 0.0 ? t / bound : 0.0);
    if (place && on_floor(*place, vehicle) < kMeetingDistance) return true;
  }
  return false;
}

using Points = std::vector<std::pair<double, Vec3>>;

/// The piece of a track whose time 0 is the first position at or after `from_s`. A sensor that looks around before that
/// sees it approach.
Points cut(const RecordedTrack& track, double from_s, double duration_s) {
  Points piece;
  const auto first = std::ranges::find_if(track.points, [&](const auto& p) { return p.first >= from_s; });
  for (const auto& [t, p] : track.points) {
    const double since = t - first->first;
    if (since >= -kBefore && since <= duration_s) piece.emplace_back(since, p);
  }
  return piece;
}

/// Draws a turn, a mirror and a place, and moves the piece there.
void scatter(Rng& rng, Points& piece, const Box& within) {
  const double turn = rng.uniform(-std::numbers::pi, std::numbers::pi);
  const double side = rng.uniform() < 0.5 ? -1.0 : 1.0;
  Box path;
  for (auto& [t, p] : piece) {
    const double x = side * p.x();
    p = Vec3(std::cos(turn) * x - std::sin(turn) * p.y(), std::sin(turn) * x + std::cos(turn) * p.y(), p.z());
    if (t >= 0.0) path.extend(p);
  }
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = within.min()[axis] - path.min()[axis];
    const double high = within.max()[axis] - path.max()[axis];
    const double u = rng.uniform();
    shift[axis] = low <= high ? low + u * (high - low) : 0.5 * (low + high);
  }
  for (auto& [t, p] : piece) p += shift;
}

ObstacleSpec draw_copy(Rng& rng, const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                       double duration_s) {
  const RecordedTrack& track = tracks[static_cast<std::size_t>(rng.uniform() * static_cast<double>(tracks.size()))];
  const double first = track.points.front().first;
  const double latest = std::max(first, track.points.back().first - duration_s);
  WaypointMotion motion;
  motion.points = cut(track, rng.uniform(first, latest), duration_s);
  scatter(rng, motion.points, spec.within);
  ObstacleSpec o;
  o.half_extents = spec.half_extents;
  o.centre = motion.points.front().second;
  o.motion = std::move(motion);
  return o;
}

bool crowds_start(const ObstacleSpec& o, const Vec3& start) {
  for (int i = 0; i * kStartSample <= kStartQuiet; ++i) {
    if (distance_to_box(start, motion_state(o, i * kStartSample).p, o.half_extents) < kStartClearance) return true;
  }
  return false;
}

}  // namespace

bool crowds_start(const RecordedTrack& track, double t_s, const Vec3& start) {
  for (int i = 0; i * kStartSample <= kStartQuiet; ++i) {
    const auto place = place_at(track, t_s + i * kStartSample);
    if (place && on_floor(*place, start) < kStartClearance) return true;
  }
  return false;
}

Result<double> draw_start(Rng& rng, const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                          const UavSpec& uav) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const RecordedTrack& track : tracks) {
    first = std::min(first, track.points.front().first);
    last = std::max(last, track.points.back().first);
  }
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    const double t = std::floor(rng.uniform(first, last) * spec.frames_per_second) / spec.frames_per_second;
    const bool met = std::ranges::any_of(
        tracks, [&](const RecordedTrack& track) { return meets(track, t, uav) && !crowds_start(track, t, uav.start); });
    if (met) return t;
  }
  return fail(fmt::format("{}: nobody comes within {} m of the straight way at any of {} moments from {} s to {} s",
                          spec.file, kMeetingDistance, kMaxDraws, first, last));
}

Result<ScatteredCopies> scatter_copies(Rng& rng, const std::vector<RecordedTrack>& tracks,
                                       const RecordedTracksSpec& spec, const Vec3& start, double duration_s) {
  const std::string stem = std::filesystem::path(spec.file).stem().string();
  ScatteredCopies made;
  for (int k = 0; k < spec.copies; ++k) {
    ObstacleSpec o = draw_copy(rng, tracks, spec, duration_s);
    for (int again = 0; crowds_start(o, start); ++again, ++made.redrawn) {
      if (again == kMaxRedraws) {
        return fail(fmt::format("{}: no place for copy {} clear of the start in {} draws", spec.file, k, kMaxRedraws));
      }
      o = draw_copy(rng, tracks, spec, duration_s);
    }
    o.name = fmt::format("{}~{}", stem, k);
    made.obstacles.push_back(std::move(o));
  }
  return made;
}

}  // namespace tern
