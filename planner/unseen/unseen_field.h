// A lower bound of the distance to every upright mover that no sensor has seen, in the plane.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.h"
#include "core/world/vehicle.h"
#include "planner/unseen/sight_fan.h"

namespace tern {

/// Square cells of the plane at the vehicle's height. Places outside of them are unknown.
struct UnseenGrid {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< the lower corner of cell (0, 0), W, m
  double cell = 0.25;                                ///< edge h, m, > 0
  int nx = 64, ny = 64;                              ///< cells per axis, ≥ 1

  [[nodiscard]] Eigen::Vector2d centre(int ix, int iy) const {
    return {origin.x() + (ix + 0.5) * cell, origin.y() + (iy + 0.5) * cell};
  }
};

/// A lower bound D of the distance from each cell's centre to P, the places where a part of an unseen mover may be.
///
/// A mover is as fast as `max_speed` or slower, contains a square of edge `least_width`, and is upright: it crosses the
/// vehicle's height. For each set of pictures:
///
/// 1. Time: D ← max(0, D − w Δt). A mover comes nearer by at most w Δt.
/// 2. A cell is a candidate unless a picture shows it to be empty, something known fills it, or D > k. Here k is half
///    the cell's diagonal. Only candidates hold parts of movers. A picture that is older by some age must show all
///    within w · age of the cell to be empty.
/// 3. A candidate counts only within a block of m × m candidates, m = ⌈least_width / h⌉: a mover touches all of them.
/// 4. D ← max(D, distance to the nearest such cell's square), at most kFarthest. Beyond the grid, all cells count.
///
/// Both values in step 4 are lower bounds, so their maximum is. Time alone never raises D. O(cells).
class UnseenField {
 public:
  /// Before the first picture an unseen mover may be anywhere: D = 0.
  UnseenField(const UnseenGrid& grid, double max_speed, double least_width);

  /// States that no mover is within this ball at present, as at take-off.
  void clear_ball(const Eigen::Vector2d& centre, double radius);
  /// Moves the window by whole cells; nobody is known to be absent in the cells that enter it.
  void shift(int dx, int dy);
  /// Steps 1 to 4 for pictures of one time, Δt seconds after the last ones, and for late ones with their ages.
  /// @param filled  cells that something known fills entirely, nx·ny flags, row by row; empty: none
  void update(double dt_s, const std::vector<SightFan>& fans, const std::vector<std::uint8_t>& filled = {});

  /// Returns a lower bound of the distance from p (W, m) to every unseen mover, m, ≥ 0. It is the largest of
  /// D(c) − |p − c| over the four cells around p. It is 1-Lipschitz inside the grid, and 0 outside.
  [[nodiscard]] double distance(const Eigen::Vector2d& p) const;
  [[nodiscard]] double at(int ix, int iy) const { return d_[index(ix, iy)]; }
  [[nodiscard]] const UnseenGrid& grid() const { return grid_; }
  [[nodiscard]] double max_speed() const { return max_speed_; }

  /// Distances beyond this are not told apart, m.
  static constexpr double kFarthest = 4.0;

 private:
  [[nodiscard]] std::size_t index(int ix, int iy) const { return idx(iy * grid_.nx + ix); }
  void find_candidates(const std::vector<SightFan>& fans, const std::vector<std::uint8_t>& filled);
  void keep_blocks();
  void raise();

  UnseenGrid grid_;
  double max_speed_;
  int block_;  ///< m
  std::vector<double> d_;
  std::vector<std::uint8_t> candidate_, kept_, padded_;
  std::vector<double> rows_, least_;
};

/// Returns the time, s after `from`, up to which no unseen mover can touch the vehicle on this trajectory. It is the
/// first time s at which this condition fails, or else the time at which the vehicle comes to rest:
///
///     distance(p(s)) − w (s + latency) > radius
///
/// A mover that touches a vehicle at rest is not the planner's concern. The condition is tested at steps of `step_s`,
/// with the margin (v + w) step_s / 2, where v is the speed there.
/// @param radius  of the body about its vertical axis, m
double clear_until(const TimedSpline& trajectory, UTime from, const UnseenField& field, double latency_s, double radius,
                   double step_s = 0.01);

}  // namespace tern
