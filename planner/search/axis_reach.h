// The velocities from which one axis of the clamped spline can still come to rest.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

/// One axis for one Δt and J: the exact set of (velocity, acceleration) from which the spline can end at rest.
///
/// Let v_l be the velocity control points and a_l the accelerations at the knots. For l = 1 … n−3,
///
///     v_{l+1} = v_l + a_l Δt,   |v_l| ≤ v_max,   |a_l| ≤ a_max,   |a_l − a_{l−1}| ≤ j_max Δt,
///
/// and the end at rest requires v_{n−2} = 0 and a_{n−2} = 0. The sets K_l of (v_l, a_{l−1}) from which these can be
/// satisfied are convex polygons. They are computed backwards from K_{n−2}. See docs/planner/search.md.
class AxisReach {
 public:
  /// Has no limits until assign().
  AxisReach() = default;
  AxisReach(int intervals, double interval_s, double v_max, double a_max, double j_max) {
    assign(intervals, interval_s, v_max, a_max, j_max);
  }
  /// Computes all K_l. @pre intervals ≥ 4, limits > 0; j_max may be infinite. The memory is kept from call to call.
  /// @param intervals  J. @param interval_s  Δt, s
  void assign(int intervals, double interval_s, double v_max, double a_max, double j_max);
  /// Computes the sets for one step within these limits, after which all later steps are within those of `rest`. The
  /// bound on the velocity v_l is the fastest corner of K_l.
  /// @pre a_max and j_max of `rest` are not larger than these
  void assign_before(const AxisReach& rest, double a_max, double j_max);

  struct Interval {
    double low, high;  ///< empty if low > high
    [[nodiscard]] bool empty() const { return low > high; }
  };
  /// Returns the range of v_{l+1} within the limits from which the spline can still end at rest, for 1 ≤ l ≤ n − 3 =
  /// J − 1.
  [[nodiscard]] Interval next_velocity(int l, double v, double a_previous) const;

  /// Returns bounds of q_{n−2} − q_l for a given v_{l−1}, m; 2 ≤ l ≤ n − 2 = J. They ignore the jerk limit. After
  /// assign_before() they include it as far as it bounds each velocity alone.
  [[nodiscard]] Interval displacement(int l, double v_previous) const;

 private:
  using Polygon = std::vector<Eigen::Vector2d>;  ///< corners (v, a), counter-clockwise
  void set_limits(int intervals, double interval_s, double v_max, double a_max, double j_max);
  void close_end(double j_step);
  /// Computes K_l from K_{l+1} = `next`, where an acceleration may change by j_step.
  void step_back(const Polygon& next, double j_step, std::size_t l);
  [[nodiscard]] double farthest(int l, double v_previous) const;

  int intervals_ = 0;
  double dt_ = 0.0, v_max_ = 0.0, a_max_ = 0.0, j_step_ = 0.0;
  std::vector<Polygon> finishable_;  ///< [l] = K_l, l = 2 … J
  std::vector<double> fastest_;      ///< [k]: the largest v_k that can still be braked to rest, k = 2 … J − 1, m/s
  Polygon scratch_[2];
};

}  // namespace tern
