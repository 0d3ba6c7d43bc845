#include "simulator/referee/clearance.h"

#include <algorithm>
#include <cmath>

#include "simulator/referee/first_time.h"

namespace tern {
namespace {

/// Golden section stops when the bracket is this long on the chord, m: well under kContactTolerance.
constexpr double kChordTolerance = 1e-7;
/// Shortest interval, s: about ten roundings of a world time.
constexpr double kMinIntervalDuration = 1e-9;

struct ChordMinimum {
  double at = 0.0;     ///< in [0, 1]
  double value = 0.0;  ///< at most `error` above the minimum
  double error = 0.0;
};

/// The minimum over s ∈ [0, 1] of a convex f with |f(a) − f(b)| ≤ length·|a − b|.
template <class F>
ChordMinimum minimize_on_chord(const F& f, double length) {
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0;
  double high = 1.0;
  ChordMinimum best{0.0, f(0.0), 0.0};
  const auto take = [&](double s) {
    const double value = f(s);
    if (value < best.value) best = {s, value, 0.0};
    return value;
  };
  take(1.0);
  double s1 = high - kGolden * (high - low);
  double s2 = low + kGolden * (high - low);
  double f1 = take(s1);
  double f2 = take(s2);
  while ((high - low) * length > kChordTolerance) {
    if (f1 <= f2) {
      high = s2;
      s2 = s1;
      f2 = f1;
      s1 = high - kGolden * (high - low);
      f1 = take(s1);
    } else {
      low = s1;
      s1 = s2;
      f1 = f2;
      s2 = low + kGolden * (high - low);
      f2 = take(s2);
    }
  }
  best.error = (high - low) * length;
  return best;
}

}  // namespace

/// The flight against one obstacle.
struct ClearanceWatch::Pair {
  const FlownPiece& piece;
  const WorldObstacle& obstacle;
  const BodyDistance& distance;
  double speed;         ///< bound of the relative speed, m/s
  double acceleration;  ///< bound of the relative acceleration, m/s²

  [[nodiscard]] Vec3 relative(double t) const { return piece.at(t).p - obstacle.at(t).p; }
  [[nodiscard]] double operator()(double t) const { return distance(relative(t), obstacle.half_extents()); }
};

ClearanceWatch::ClearanceWatch(const World& world, const Body& body) : world_(world), distance_(body) {
  sightings_.resize(world.obstacles.size());
  for (const WorldObstacle& o : world.obstacles) {
    speeds_.push_back(o.bounds().speed.norm());
    accelerations_.push_back(o.bounds().acceleration.norm());
  }
}

std::optional<Contact> ClearanceWatch::advance(const FlownPiece& piece, double t0_s, double t1_s) {
  const double v = piece.speed_bound(t0_s, t1_s);
  const double a = piece.acceleration_bound(t0_s, t1_s);
  odometer_ += v * (t1_s - t0_s);
  std::optional<Contact> first;
  for (std::size_t i = 0; i < world_.obstacles.size(); ++i) {
    Sighting& seen = sightings_[i];
    const double at_least = seen.distance - (odometer_ - seen.odometer) - speeds_[i] * (t1_s - seen.time_s);
    if (at_least >= std::max(min_, 0.0)) continue;  // first, as the obstacles of a large map lie far apart in memory
    const WorldObstacle& o = world_.obstacles[i];
    if (t1_s < o.first_s() || t0_s > o.last_s()) continue;
    const Pair pair{piece, o, distance_, v + speeds_[i], a + accelerations_[i]};
    const auto contact = meet(pair, std::max(t0_s, o.first_s()), std::min(t1_s, o.last_s()));
    if (contact && (!first || *contact < first->time_s)) first = Contact{*contact, o.id()};
    seen = {pair(t1_s), odometer_, t1_s};
  }
  return first;
}

/// Searches the parts between corners. @return the first contact, if a minimum is negative
std::optional<double> ClearanceWatch::meet(const Pair& pair, double t0_s, double t1_s) {
  for (double from = t0_s;;) {
    const double to = std::min(t1_s, pair.obstacle.next_corner(from));
    const double overlap = search(pair, from, to);
    if (!std::isnan(overlap)) {
      return first_time_below_zero(pair, pair.speed, from, to, kContactTimeResolution).value_or(overlap);
    }
    if (to >= t1_s) return std::nullopt;
    from = to;
  }
}

/// Lowers min_ to the minimum over [t0, t1]. @return an instant of overlap, or NaN
double ClearanceWatch::search(const Pair& pair, double t0_s, double t1_s) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double h = t1_s - t0_s;
  const Vec3 from = pair.relative(t0_s);
  const Vec3 chord = pair.relative(t1_s) - from;
  const double deviation = pair.acceleration * h * h / 8.0;
  const auto along = [&](double s) { return distance_(from + s * chord, pair.obstacle.half_extents()); };
  const double length = chord.norm();
  if (along(0.5) - 0.5 * length - deviation >= std::max(min_, 0.0)) return kNone;

  const ChordMinimum least = minimize_on_chord(along, length);
  const double lower = least.value - least.error - deviation;
  const double at = t0_s + least.at * h;
  const double upper = pair(at);
  min_ = std::min(min_, upper);
  const bool sign_open = lower < 0.0 && upper >= 0.0;
  const double enough = sign_open ? kContactTolerance : kClearanceTolerance;
  const double best = sign_open ? upper : min_;  // min_ may be another obstacle's overlap
  const bool settled = best - lower <= enough || h < kMinIntervalDuration;
  if (settled) return upper < -kTouchTolerance ? at : kNone;
  const double middle = t0_s + 0.5 * h;
  const double early = search(pair, t0_s, middle);
  const double late = search(pair, middle, t1_s);
  return std::isnan(early) ? late : early;
}

}  // namespace tern
