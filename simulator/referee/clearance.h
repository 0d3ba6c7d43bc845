// Clearance in continuous time: the least distance between the flown body and every true obstacle, without gaps between
// samples.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/world/body_distance.h"
#include "simulator/referee/flown_piece.h"
#include "simulator/worlds/world.h"

namespace tern {

/// The reported minimum is attained at some instant, and exceeds the true minimum by at most this, m.
inline constexpr double kClearanceTolerance = 1e-3;
/// The sign of the minimum is right if its magnitude is at least this, m.
inline constexpr double kContactTolerance = 1e-6;
/// Bodies that overlap by less than this touch, and are not in contact, m: rounding of coordinates up to 1e5 m.
inline constexpr double kTouchTolerance = 1e-9;
/// Accuracy of the time of the first contact, s.
inline constexpr double kContactTimeResolution = 1e-6;

/// A body's first overlap with an obstacle, beyond kTouchTolerance.
struct Contact {
  double time_s = 0.0;  ///< world time
  std::int64_t id = 0;  ///< of the obstacle
};

/// Computes the clearance along a flight, step by step.
///
/// A corner is a time at which an obstacle's velocity jumps (WorldObstacle::next_corner). Between corners, the relative
/// position over [t0, t1] deviates from its chord by at most a (t1 − t0)²/8. Here a is the sum of both bounds of
/// acceleration. Along the chord the signed distance is convex, so golden section finds its minimum to a known error.
/// The chord's minimum minus error and deviation is a proven lower bound. Intervals are halved until lower and upper
/// bound agree to kClearanceTolerance, and further while they differ in sign.
///
/// Prefilter: an obstacle seen at distance d cannot be nearer than d − (metres flown since) − (its speed bound)·(time
/// since). So most steps look at few obstacles: 300 obstacles at 100 Hz cost microseconds a step.
class ClearanceWatch {
 public:
  /// The world must outlive the watch.
  ClearanceWatch(const World& world, const Body& body);

  /// Takes the flight over [t0, t1], world time, s. @pre t0 is the last t1 (0 at first), and `piece` holds throughout
  /// @return the first contact in it, or nullopt. Of contacts at the same time, the one with the least id is returned
  std::optional<Contact> advance(const FlownPiece& piece, double t0_s, double t1_s);

  /// Least clearance so far, m; ∞ if no obstacle was present.
  [[nodiscard]] double min_clearance() const { return min_; }

 private:
  struct Sighting {
    double distance = -std::numeric_limits<double>::infinity();  ///< m; −∞: never seen
    double odometer = 0.0;                                       ///< m flown at that time
    double time_s = 0.0;
  };
  struct Pair;
  std::optional<double> meet(const Pair& pair, double t0_s, double t1_s);
  double search(const Pair& pair, double t0_s, double t1_s);

  const World& world_;
  BodyDistance distance_;
  std::vector<Sighting> sightings_;
  std::vector<double> speeds_;         ///< per obstacle, bound of ‖v‖, m/s
  std::vector<double> accelerations_;  ///< per obstacle, bound of ‖a‖ between corners, m/s²
  double odometer_ = 0.0;              ///< bound of the metres flown
  double min_ = std::numeric_limits<double>::infinity();
};

}  // namespace tern
