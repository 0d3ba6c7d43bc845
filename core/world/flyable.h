// The rule by which a trajectory may be flown: what the planner's checker and the executor both ask.
#pragma once

#include <cstdint>
#include <string>

#include "core/world/vehicle.h"

namespace tern {

/// The rule that a trajectory breaks, in the order in which breach_of() looks at them; the last three are the
/// planner's.
enum class Breach : std::uint8_t {
  None = 0,
  Shape = 1,  ///< fewer than 4 or more than kMaxIntervals intervals, Δt not in (0, kMaxIntervalDuration], not finite
  Start = 2,  ///< does not start at t_s
  Join = 3,   ///< position, velocity or acceleration differ from the start state's by more than kJoinTolerance
  End = 4,    ///< does not end at rest: q_{n-2} = q_{n-1} = q_n
  Velocity = 5,        ///< beyond v_max at its true extremum
  Acceleration = 6,    ///< beyond a_max
  Jerk = 7,            ///< beyond j_max
  Thrust = 8,          ///< below thrust_min or beyond thrust_max of Dynamics
  Tilt = 9,            ///< beyond tilt_max
  BodyRate = 10,       ///< beyond body_rate_max
  FlightBox = 11,      ///< the body leaves the flight box
  Sphere = 12,         ///< a MINVO point leaves S
  NotSeparated = 13,   ///< an obstacle is not separated from an interval
  TooManyPlanes = 14,  ///< the certificate does not fit into a plan (kMaxCertificatePlanes)
};
inline constexpr int kBreaches = 15;

/// The first rule broken, with value and limit.
struct BreachReport {
  Breach breach = Breach::None;
  const char* format = "";          ///< of text(): {0} value, {1} limit, {2} axis
  double value = 0.0, limit = 0.0;  ///< what was found and what was allowed
  int axis = -1;                    ///< 0 … 2 where the rule is one per axis
  int interval = -1;                ///< where, if the rule is one per interval

  [[nodiscard]] bool ok() const { return breach == Breach::None; }
  /// In words: "|v| x = 6.5 beyond 6"; empty when nothing is broken.
  [[nodiscard]] std::string text() const;
};

/// Where the vehicle's position may be so that its body is inside the flight box, W. Its min exceeds its max where the
/// body is larger than the box.
Box centre_box(const Box& flight_box, const Body& body);

/// Whether thrust, tilt and body rates keep to the dynamics to kLimitTolerance of each, at true extrema. O(J).
BreachReport breach_of(const ClampedSpline& spline, const Dynamics& dynamics);

/// Whether `trajectory` may be flown from t_s and `start` on: its form, its start, joining `start`, resting at the end.
/// Limits hold for |v|, |a|, |j|, thrust, tilt and body rates to kLimitTolerance of each, and the centre box to
/// kBoxTolerance. All are judged at true extrema. O(J), allocates nothing but the spline.
BreachReport breach_of(const TimedSpline& trajectory, UTime t_s, const MotionSample& start, const Limits& limits,
                       const Box& centre_box);

}  // namespace tern
