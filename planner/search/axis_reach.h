// Which velocities can still be braked to rest: one axis of the clamped spline as a chain of accelerations.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tern {

/// The limits of one axis for one Δt and J: the exact set of (velocity, acceleration) from which the spline can end at
/// rest.
///
/// Let v_l be the velocity control points and a_l the accelerations at the knots. Then v_{l+1} = v_l + a_l Δt for l = 1
/// … n−3, and the end at rest asks v_{n-2} = 0, a_{n-2} = 0. Limits: |v_l| ≤ v_max, |a_l| ≤ a_max, |a_l − a_{l-1}| ≤
/// j_max Δt (the jerk of an interval). The sets K_l of (v_l, a_{l-1}) that can be finished are convex polygons,
/// computed backwards from K_{n-2}.
class AxisReach {
 public:
  /// Nothing until assign().
  AxisReach() = default;
  AxisReach(int intervals, double interval_s, double v_max, double a_max, double j_max) {
    assign(intervals, interval_s, v_max, a_max, j_max);
  }
  /// @param intervals J ≥ 4; @param interval_s Δt, s; limits > 0, j_max may be infinite. Keeps its memory.
  void assign(int intervals, double interval_s, double v_max, double a_max, double j_max);
  /// One step by these limits, all later ones by those of `rest`, whose a_max and j_max are not larger. The states are
  /// those from which `rest` can still finish; none of them is faster than the fastest corner of its K_l.
  void assign_before(const AxisReach& rest, double a_max, double j_max);

  struct Interval {
    double low, high;  ///< empty when low > high
    [[nodiscard]] bool empty() const { return low > high; }
  };
  /// Every v_{l+1} that obeys the limits and can still end at rest, given v_l and a_{l-1}; 1 ≤ l ≤ n − 3 = J − 1.
  [[nodiscard]] Interval next_velocity(int l, double v, double a_previous) const;

  /// How far q_{n-2} − q_l can lie, given v_{l-1}: bounds that ignore the jerk limit, m; 2 ≤ l ≤ n − 2 = J. After
  /// assign_before() they know it as far as it bounds each velocity alone.
  [[nodiscard]] Interval displacement(int l, double v_previous) const;

 private:
  using Polygon = std::vector<Eigen::Vector2d>;  ///< (v, a) counter-clockwise
  void set_limits(int intervals, double interval_s, double v_max, double a_max, double j_max);
  void close_end(double j_step);
  /// K_l, from K_{l+1} = `next`, from which accelerations may change by j_step.
  void step_back(const Polygon& next, double j_step, std::size_t l);
  [[nodiscard]] double farthest(int l, double v_previous) const;

  int intervals_ = 0;
  double dt_ = 0.0, v_max_ = 0.0, a_max_ = 0.0, j_step_ = 0.0;
  std::vector<Polygon> finishable_;  ///< [l] = K_l, l = 2 … J
  std::vector<double> fastest_;      ///< [k]: no v_k that can still be braked is larger, k = 2 … J − 1, m/s
  Polygon scratch_[2];
};

}  // namespace tern
