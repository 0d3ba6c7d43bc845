// The yaw along a plan: its limits, its values, and the rules that it must obey to be flown. The planner, the executor
// and the viewer all use them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/knobs.h"
#include "core/splines/clamped_spline.h"
#include "core/world/plan_heading.h"

namespace tern {

/// The section `uav.heading`: how fast the vehicle may turn about the vertical, and how wide its sensors see.
struct HeadingLimits {
  double rate_max_deg_s = 120.0;
  double acceleration_max_deg_s2 = 360.0;
  double view_deg = 85.2;
  friend bool operator==(const HeadingLimits&, const HeadingLimits&) = default;

  template <typename V>
  void visit(V& v) {
    v("rate_max", rate_max_deg_s, Range{1.0, 1000.0}, "largest yaw rate of a planned heading, degrees/s");
    v("acceleration_max", acceleration_max_deg_s2, Range{1.0, 1e5},
      "largest yaw acceleration of a planned heading, degrees/s²");
    v("view", view_deg, Range{5.0, 360.0},
      "horizontal angle that the vehicle's sensors see together, centred on its heading, degrees");
  }
};

/// A yaw joins another one if they agree to this, rad and rad/s.
inline constexpr double kYawJoinTolerance = 1e-6;

/// Returns the same direction in (−π, π], rad.
double wrapped_yaw(double yaw);

/// The yaw at one instant.
struct YawSample {
  double yaw = 0.0;   ///< rad, about W's z from W's x; not wrapped
  double rate = 0.0;  ///< rad/s
};

/// The yaw of a PLAN_HEADING over time.
class HeadingSpline {
 public:
  /// @throws std::invalid_argument if the form is not that of ClampedSpline
  explicit HeadingSpline(const PlanHeading& heading);

  [[nodiscard]] UTime start() const { return start_; }
  [[nodiscard]] UTime end() const;
  /// Returns the yaw at t. Before the start it is that of the start, after the end that of the end, at rate 0.
  [[nodiscard]] YawSample sample(UTime t) const;
  /// The extrema over the whole spline, up to rounding.
  [[nodiscard]] double largest_rate() const;          ///< rad/s
  [[nodiscard]] double largest_acceleration() const;  ///< rad/s²

 private:
  UTime start_;
  Duration interval_;
  ClampedSpline yaw_;  ///< along x, rad
};

/// The rule that a heading breaks, in the order in which heading_breach() tests them.
enum class HeadingBreach : std::uint8_t {
  None = 0,
  Shape = 1,         ///< fewer than 4 or more than kMaxIntervals intervals, Δt ≤ 0, or a number not finite
  End = 2,           ///< the yaw still turns at the end
  Rate = 3,          ///< the rate exceeds its limit
  Acceleration = 4,  ///< the acceleration exceeds its limit
  Join = 5,          ///< yaw or rate at the start differ from those of the heading before by > kYawJoinTolerance
};
inline constexpr int kHeadingBreaches = 6;
/// Returns "shape", "rate" …
const char* to_string(HeadingBreach breach);

struct HeadingBreachReport {
  HeadingBreach breach = HeadingBreach::None;
  std::string text = {};  ///< with value and limit

  [[nodiscard]] bool ok() const { return breach == HeadingBreach::None; }
};

/// Returns the first rule that a heading breaks. Limits have the tolerance kLimitTolerance. O(J) for J intervals.
/// @param before  the heading before, at the start of this one; nullopt: there is none, and any start is allowed
HeadingBreachReport heading_breach(const PlanHeading& heading, const HeadingLimits& limits,
                                   const std::optional<YawSample>& before);

}  // namespace tern
