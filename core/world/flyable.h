// The rules that a trajectory must obey to be flown. The planner's checker and the executor both use them.
#pragma once

#include <cstdint>
#include <string>

#include "core/world/vehicle.h"

namespace tern {

/// The rule that a trajectory breaks, in the order in which breach_of() tests them. The planner alone tests the last
/// three.
enum class Breach : std::uint8_t {
  None = 0,
  Shape = 1,           ///< J outside 4 … kMaxIntervals, Δt outside (0, kMaxIntervalDuration], or a number not finite
  Start = 2,           ///< does not start at t_s
  Join = 3,            ///< position, velocity or acceleration differs from the start by more than kJoinTolerance
  End = 4,             ///< does not end at rest with q_{n-2} = q_{n-1} = q_n
  Velocity = 5,        ///< |v| beyond v_max at a true extremum
  Acceleration = 6,    ///< |a| beyond a_max
  Jerk = 7,            ///< |j| beyond j_max
  Thrust = 8,          ///< thrust below thrust_min or beyond thrust_max (Dynamics)
  Tilt = 9,            ///< tilt beyond tilt_max (Dynamics)
  BodyRate = 10,       ///< body rate beyond body_rate_max (Dynamics)
  FlightBox = 11,      ///< the body leaves the flight box
  Sphere = 12,         ///< a MINVO point leaves the sphere S
  NotSeparated = 13,   ///< an obstacle is not separated from an interval
  TooManyPlanes = 14,  ///< the certificate needs more than kMaxCertificatePlanes
};
inline constexpr int kBreaches = 15;

/// The first rule that a trajectory breaks, with value and limit.
struct BreachReport {
  Breach breach = Breach::None;
  const char* format = "";          ///< format of text(): {0} value, {1} limit, {2} axis
  double value = 0.0, limit = 0.0;  ///< found and allowed
  int axis = -1;                    ///< 0 … 2; −1 if the rule has no axis
  int interval = -1;                ///< −1 if the rule has no interval

  [[nodiscard]] bool ok() const { return breach == Breach::None; }
  /// Returns the breach in words, "|v| x = 6.5 beyond 6"; empty if there is none.
  [[nodiscard]] std::string text() const;
};

/// Returns the box of positions at which the body lies inside the flight box (W). Its min exceeds its max on each axis
/// where the body is larger than the flight box.
Box centre_box(const Box& flight_box, const Body& body);

/// Tests thrust, tilt and body rates at their true extrema, each to kLimitTolerance. O(J).
BreachReport breach_of(const ClampedSpline& spline, const Dynamics& dynamics);

/// Tests whether `trajectory` may be flown from t_s on. Extrema are true ones. O(J); allocates the spline only.
///
/// 1. Its form is legal; it starts at t_s, joins `start` to kJoinTolerance, and ends at rest.
/// 2. |v|, |a|, |j|, thrust, tilt and body rates obey their limits to kLimitTolerance.
/// 3. Its positions stay in the centre box to kBoxTolerance.
BreachReport breach_of(const TimedSpline& trajectory, UTime t_s, const MotionSample& start, const Limits& limits,
                       const Box& centre_box);

}  // namespace tern
