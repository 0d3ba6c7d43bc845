// Distances and paths to a goal around static obstacles, computed once per (map, static boxes, goal) before requests
// come in.
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
  double resolution = 0.25;  ///< spacing of grid lines, m; enlarged if the region would need more than max_nodes
  std::int64_t max_nodes = 150'000;  ///< limits build time; lines added in gaps may double the number
  double margin = 2.0;               ///< free space around start, goal and obstacles that is searched, m
  std::optional<Vec3> start;         ///< enlarges the searched region; paths from elsewhere are possible, W
  Vec3 anchor = Vec3::Zero();        ///< grid lines pass through this point; for a map it is the centre of a voxel, W
  TravelCost cost;                   ///< the field keeps a copy; objects that it refers to must outlive the field
};

/// Distances to a goal on the nodes of a rectilinear grid.
///
///  - Search: any-angle Dijkstra from the goal (Lazy Theta*, Nash et al. 2010, without a heuristic). Every reached
///    node knows a visible turning point on its way to the goal, so paths are not bound to the grid's directions.
///  - Free space is decided by exact tests: every segment is tested against the boxes. A gap of less than two steps
///    gets a grid line at its middle if it has none. The gap may be between two boxes, or between a box and the
///    flight box. So a window of 0.6 m stays open to a vehicle of 0.2 m in a grid of 0.25 m.
///  - Cost: with a TravelCost the path of least cost is sought instead of the shortest. It leads around repulsive
///    regions and through attractive ones as far as that pays. With a `priced` cost a node carries the drift of its
///    way. The path is longer where seeing is worth it.
///  - Region: the bounds of goal, options.start, obstacles and cost.region, plus a margin, cut by the flight box.
///    Open worlds (flight boxes of ±10⁴ m) cost as much as their obstacles.
///
/// The field is deterministic: ties are broken by node index, and of libm only sqrt is used.
class GoalField {
 public:
  GoalField() = default;

  /// Computes the field, at about 1 µs per node: 120 ms for the corridor of 75×6×4 m.
  ///
  /// If the goal is in a box or outside the flight box, no node reaches it.
  /// @param inflated_statics positions of the centre at which the body touches an obstacle, grown by the wanted
  /// clearance, W. Paths keep only kPathClearance from them. The order of the boxes does not matter.
  /// @param flight_box  allowed positions of the vehicle's centre, W
  /// @param goal  W
  static GoalField build(std::vector<Box> inflated_statics, const Box& flight_box, const Vec3& goal,
                         const GoalFieldOptions& options = {});

  /// Returns a taut piecewise-linear path from start to goal, both included, clear of every box; nullopt if there is
  /// none.
  ///
  /// Taut means that no vertex can be pulled to a cheaper position. A box that contains the start blocks only with its
  /// part core_beyond() the start, so that the path can leave the box. In simple cases the path is at most a few
  /// percent longer than the shortest one. Takes about 10 µs, with a TravelCost about 100 µs.
  [[nodiscard]] std::optional<std::vector<Vec3>> path_from(const Vec3& start) const;

  /// Returns the box that blocks the way if there is no path, for a message to people.
  ///
  /// It is the box that contains the goal. Otherwise it is the nearest box on the straight line from start to the
  /// nearest node that reaches the goal. Takes about 1 µs per node.
  /// @return nullopt if no single box blocks, for example if the goal is outside the flight box
  [[nodiscard]] std::optional<Box> blocker(const Vec3& start) const;

  [[nodiscard]] const Vec3& goal() const { return goal_; }
  [[nodiscard]] const TravelCost& cost() const { return cost_; }
  [[nodiscard]] const BoxIndex& obstacles() const { return obstacles_; }
  [[nodiscard]] std::int64_t nodes() const { return static_cast<std::int64_t>(to_go_.size()); }
  /// Returns the bounds of the searched region, W.
  [[nodiscard]] Box region() const { return to_go_.empty() ? Box() : Box(grid_.low(), grid_.high()); }

 private:
  using Cell = Eigen::Vector3i;

  void lay_grid(const GoalFieldOptions& options);
  void open_gaps(double step);
  [[nodiscard]] Vec3 position(std::int32_t node) const;
  [[nodiscard]] double to_go(std::int32_t node) const;
  [[nodiscard]] std::int32_t first_turn(const Vec3& start) const;
  [[nodiscard]] double step_cost(const Vec3& from, std::int32_t turn) const;
  [[nodiscard]] Drift drift_from(const std::vector<Vec3>& path, std::size_t k) const;
  void tighten(std::vector<Vec3>& path) const;

  Vec3 goal_ = Vec3::Zero();
  Box flight_box_;
  bool goal_free_ = false;
  TravelCost cost_;
  BoxIndex obstacles_;
  RectilinearGrid grid_;
  std::vector<double> to_go_;       ///< per node: cost to the goal, m; infinite if it is not reached
  std::vector<std::int32_t> next_;  ///< per node: the visible turning point (a node, or kGoalNode)
  std::vector<Drift> drift_;        ///< per node: of its way to the goal, if the cost is `priced`
};

}  // namespace tern
