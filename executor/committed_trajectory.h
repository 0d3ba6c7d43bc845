// What the vehicle flies: splines one after the other, each in force from its start until the next one's.
#pragma once

#include <vector>

#include "core/splines/piecewise_cubic.h"
#include "core/world/vehicle.h"

namespace tern {

/// The committed trajectory. Invariants: it has at least one segment; segments start in ascending order; each ends at
/// rest. So the vehicle comes to rest whatever is lost after a segment, and rests for ever at the last one's end.
/// Joining (position, velocity, acceleration within kJoinTolerance) is the caller's rule: see Adoption.
class CommittedTrajectory {
 public:
  /// At rest at p (W, m) for ever, as a spline of four intervals that begins at `from`.
  CommittedTrajectory(const Vec3& p, UTime from);

  /// Flies `next` from its start on. @throws std::invalid_argument unless it starts after every earlier segment, has a
  /// form that ClampedSpline takes, and ends at rest.
  void splice(const TimedSpline& next);

  /// Takes back the segments that would start at t or later, all but the first.
  void drop_from(UTime t);

  /// The segment in force at t: the last that starts at or before t; before the first segment the first.
  [[nodiscard]] const TimedSpline& in_force_at(UTime t) const;
  /// The motion at any t; before the first segment at rest at its first point.
  [[nodiscard]] MotionSample sample(UTime t) const;
  /// The very splines between two times as cubic pieces, a piece per interval or part of it, rest included.
  /// The same curve to rounding. @throws std::invalid_argument unless from < to. O(segments + pieces).
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const;
  /// From here on it rests.
  [[nodiscard]] UTime end() const { return segments_.back().timed.end(); }
  [[nodiscard]] UTime newest_start() const { return segments_.back().timed.start; }
  [[nodiscard]] std::size_t segments() const { return segments_.size(); }

  /// Forgets the segments that are no longer in force at t; earlier times are then answered wrongly.
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
