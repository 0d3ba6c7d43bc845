// The committed trajectory: a sequence of splines, each in force from its start until the next one starts.
#pragma once

#include <vector>

#include "core/splines/piecewise_cubic.h"
#include "core/world/vehicle.h"

namespace tern {

/// The trajectory that the vehicle flies unless a newer plan is adopted.
///
/// Invariants: there is at least one segment; segments start in ascending order; each segment ends at rest. So the
/// vehicle comes to rest even if no further message arrives, and stays at the end of the last segment.
///
/// The caller checks that segments join (position, velocity, acceleration within kJoinTolerance): see
/// check_trajectory().
class CommittedTrajectory {
 public:
  /// Constructs a trajectory at rest at p (W, m): a spline of four intervals that begins at `from`.
  CommittedTrajectory(const Vec3& p, UTime from);

  /// Appends `next`, which is in force from its start on.
  /// @throws std::invalid_argument unless `next` starts after every other segment, has a form that ClampedSpline
  /// accepts, and ends at rest.
  void splice(const TimedSpline& next);

  /// Removes the segments that start at t or later. The first segment is always kept.
  void drop_from(UTime t);

  /// Returns the segment in force at t: the last one that starts at or before t, or the first one.
  [[nodiscard]] const TimedSpline& in_force_at(UTime t) const;
  /// Returns the motion at any t. Before the first segment it is at rest at that segment's first point.
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// Returns the motion between two times as cubic pieces, one per interval or part of an interval, rest included.
  /// Equals sample() up to rounding. @throws std::invalid_argument unless from < to. O(segments + pieces).
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const;
  /// The time from which the trajectory is at rest.
  [[nodiscard]] UTime end() const { return segments_.back().timed.end(); }
  [[nodiscard]] UTime newest_start() const { return segments_.back().timed.start; }
  [[nodiscard]] std::size_t segments() const { return segments_.size(); }

  /// Drops the segments that end their time in force before t. Queries for earlier times are wrong afterwards.
  void forget_before(UTime t);

 private:
  struct Segment {
    TimedSpline timed;
    ClampedSpline spline;
  };
  [[nodiscard]] std::size_t index_at(UTime t) const;
  std::vector<Segment> segments_;
};

}  // namespace tern
