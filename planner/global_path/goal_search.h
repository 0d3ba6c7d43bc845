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

/// Node numbers that are no nodes.
inline constexpr std::int32_t kGoalNode = -1;
inline constexpr std::int32_t kNoNode = -2;

/// Invariant of a closed node: the segment to its `next` (a node, or the goal) is free; to_go is its cost plus next's
/// to_go. Where cost is more than length, a straight line need not be the cheapest. Then the way over the node itself
/// is also tried (Theta* on weighted grids). A node is queued as if it saw the turning point of the node that found it.
/// That is tested only when it is popped; if it is false, the best closed neighbour takes its place.
class GoalSearch {
 public:
  /// Keeps references: grid, obstacles and cost must live as long as the search.
  GoalSearch(const RectilinearGrid& grid, const BoxIndex& obstacles, const Vec3& goal, const TravelCost& cost);
  void run();

  std::vector<double> to_go;       ///< per node, metres of way (TravelCost); infinite: not reached
  std::vector<std::int32_t> next;  ///< per node: the turning point it sees

 private:
  enum class State : std::uint8_t { Open, Sighted, Closed, Blocked };
  using Entry = std::pair<double, std::int32_t>;

  void block_covered_nodes();
  void queue_around_goal();
  bool sight(std::int32_t node);
  void expand(std::int32_t node);
  void offer(std::int32_t other, std::int32_t turn);
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
