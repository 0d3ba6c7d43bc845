// The any-angle Dijkstra search behind GoalField: Lazy Theta* from the goal, without a heuristic.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "planner/global_path/box_index.h"
#include "planner/global_path/rectilinear_grid.h"
#include "planner/global_path/travel_cost.h"

namespace tern {

/// Node numbers with a special meaning.
inline constexpr std::int32_t kGoalNode = -1;
inline constexpr std::int32_t kNoNode = -2;

/// The search of a GoalField.
///
/// Invariant of a closed node: the segment to its `next` (a node, or the goal) is free. Its to_go is the cost of that
/// segment plus the to_go of `next`.
///
/// A node is queued as if it saw the turning point of the node that found it. The sight of that point is tested only
/// when the node is popped. If the sight is blocked, the best closed neighbour becomes the node's `next`. Where cost
/// differs from length, a straight line may not be the cheapest. Then the way over the node itself is also tried
/// (Theta* on weighted grids).
///
/// With a cost that is `priced`, a node keeps the drift of its cheapest way alone. A dearer way with less blind time
/// may be the better beginning of a longer one: such ways are lost, which costs little (goal_field_test).
class GoalSearch {
 public:
  /// @pre grid, obstacles and cost outlive the search
  GoalSearch(const RectilinearGrid& grid, const BoxIndex& obstacles, const Vec3& goal, const TravelCost& cost);
  void run();

  std::vector<double> to_go;       ///< per node: cost to the goal (TravelCost), m; infinite if it is not reached
  std::vector<std::int32_t> next;  ///< per node: the visible turning point
  std::vector<Drift> drift;        ///< per node, with a cost that is `priced`: of its way to the goal; else empty

 private:
  enum class State : std::uint8_t { Open, Sighted, Closed, Blocked };
  using Entry = std::pair<double, std::int32_t>;

  void block_covered_nodes();
  void queue_around_goal();
  bool sight(std::int32_t node);
  void expand(std::int32_t node);
  void offer(std::int32_t other, std::int32_t turn);
  [[nodiscard]] double step_cost(const Vec3& from, std::int32_t turn, Drift& drift_there) const;
  [[nodiscard]] Vec3 position(std::int32_t node) const { return node == kGoalNode ? goal_ : grid_.position(node); }
  [[nodiscard]] double to_go_of(std::int32_t node) const { return node == kGoalNode ? 0.0 : to_go[idx(node)]; }

  const RectilinearGrid& grid_;
  const BoxIndex& obstacles_;
  Vec3 goal_;
  const TravelCost& cost_;
  std::vector<State> state_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace tern
