// How far it is to the goal around static obstacles, and along which way: once per (map, static boxes, goal), off the
// hot path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "planner/global_path/box_index.h"
#include "planner/global_path/rectilinear_grid.h"
#include "planner/global_path/travel_cost.h"

namespace tern {

struct GoalFieldOptions {
  double resolution = 0.25;          ///< spacing of grid lines, m; enlarged where the region needs more than max_nodes
  std::int64_t max_nodes = 150'000;  ///< bounds build time; lines added for gaps may double it
  double margin = 2.0;               ///< free space searched around start, goal and obstacles, m
  std::optional<Vec3> start;         ///< enlarges the region searched; starts elsewhere still work
  Vec3 anchor = Vec3::Zero();        ///< grid lines pass through it: for a map, the centre of a voxel
  TravelCost cost;                   ///< the field keeps a copy: what it calls must live as long
};

/// Goal distances on the nodes of a rectilinear grid. An any-angle Dijkstra search from the goal makes them (Lazy
/// Theta*, Nash et al. 2010, without a heuristic). Every node reached knows the visible turning point that leads it on,
/// so paths are not bound to the grid's directions.
///
/// What is free is never decided by cells. Every segment used is tested against the exact boxes. Where two boxes (or
/// box and flight box) leave a gap narrower than two steps without a grid line, one is added at its middle. So a 0.6 m
/// window stays open for a vehicle of 0.2 m in a 0.25 m grid, as does one voxel's width.
///
/// With a TravelCost the same search seeks the cheapest way instead of the shortest: every segment is weighed by the
/// cost along it. So ways lead around what repels and through what attracts as far as that pays.
///
/// The region searched is the bounds of goal, options.start, obstacles and the cost's region plus a margin, cut by the
/// flight box. Open worlds (flight boxes of ±10⁴ m) cost no more than what stands in them. Deterministic: ties by node
/// index, no libm but sqrt.
class GoalField {
 public:
  GoalField() = default;

  /// @param inflated_statics  places of the centre at which the body touches an obstacle, grown by the clearance that
  /// the caller wishes:
  ///   paths keep only kPathClearance from them. Their order matters to nothing.
  /// @param flight_box  where the vehicle's centre may be. @param goal  in W, m.
  /// A goal in a box or outside the flight box gives a field in which nothing reaches it.
  /// About 1 µs per node: 120 ms for the 75×6×4 m corridor.
  static GoalField build(std::vector<Box> inflated_statics, const Box& flight_box, const Vec3& goal,
                         const GoalFieldOptions& options = {});

  /// A taut piecewise-linear path from start to the goal, both included, clear of every box; nullopt if there is none.
  /// Taut: no vertex could be pulled to a cheaper place. Of boxes that contain the start only what
  /// lies deeper than it is in the way: the path leaves them. A few percent longer than the shortest at most in simple
  /// cases (tested); about 10 µs, with a TravelCost some 100.
  [[nodiscard]] std::optional<std::vector<Vec3>> path_from(const Vec3& start) const;

  /// What stands in the way where there is no path, for words to a person: the box that holds the goal. Or else it is
  /// the nearest box on the straight line from start to the nearest node from which the goal is reached. @return
  /// nullopt if no single box does, as where the goal is outside the flight box. About 1 µs per node.
  [[nodiscard]] std::optional<Box> blocker(const Vec3& start) const;

  [[nodiscard]] const Vec3& goal() const { return goal_; }
  [[nodiscard]] const TravelCost& cost() const { return cost_; }
  [[nodiscard]] const BoxIndex& obstacles() const { return obstacles_; }
  [[nodiscard]] std::int64_t nodes() const { return static_cast<std::int64_t>(to_go_.size()); }
  /// The bounds of the region searched.
  [[nodiscard]] Box region() const { return to_go_.empty() ? Box() : Box(grid_.low(), grid_.high()); }

 private:
  using Cell = Eigen::Vector3i;

  void lay_grid(const GoalFieldOptions& options);
  void open_gaps(double step);
  [[nodiscard]] Vec3 position(std::int32_t node) const;
  [[nodiscard]] double to_go(std::int32_t node) const;
  [[nodiscard]] std::int32_t first_turn(const Vec3& start) const;
  void tighten(std::vector<Vec3>& path) const;

  Vec3 goal_ = Vec3::Zero();
  Box flight_box_;
  bool goal_free_ = false;
  TravelCost cost_;
  BoxIndex obstacles_;
  RectilinearGrid grid_;
  std::vector<double> to_go_;       ///< per node, metres of way; infinite: not reached
  std::vector<std::int32_t> next_;  ///< per node: the turning point that it sees (a node, or kGoalNode)
};

}  // namespace tern
