// Semantic A* over control points (paper §4, Algorithm 1; differences: docs/planner/paper_gaps.md).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/world/budget.h"
#include "core/world/search_view.h"
#include "planner/problem/horizon_problem.h"
#include "planner/problem/planner_config.h"
#include "planner/safety/interval_separation.h"
#include "planner/safety/swept_obstacles.h"
#include "planner/search/search_memory.h"

namespace tern {

/// The cost-to-go h(p) = |p − point| + rest, m. `point` is a corner of the path around static obstacles, and `rest` the
/// length of the path from there to the goal.
struct CostToGo {
  Vec3 point = Vec3::Zero();
  double rest = 0.0;
  [[nodiscard]] double from(const Vec3& p) const { return (p - point).norm() + rest; }
  /// Returns the least cost-to-go of all points of a box.
  [[nodiscard]] double from(const Box& box) const { return box.exteriorDistance(point) + rest; }
};

/// The semantic cost of a step between two control points, added to f (Eq. 2), m. Empty if there are no semantics.
using StepCost = std::function<double(const Vec3& from, const Vec3& to)>;

/// The search from the start for a leaf that comes as near to the goal as possible, within plan_limits. If the start is
/// faster than plan_limits allow, the first velocities may exceed plan_limits, up to limits.v_max.
struct SearchProblem : HorizonProblem {
  CostToGo cost_to_go = {};
  StepCost accumulated = {};                          ///< summed along the path (exposure); empty: none
  std::function<double(const Vec3&)> pointwise = {};  ///< of a node alone (SemanticGuide::ahead); empty: none
  double hold_required_s = 0.5;
  bool keep_nodes = false;  ///< keep the nodes for SEARCH_VIEW; the leaf is the same
};

struct SearchResult {
  bool found = false;
  Points control_points;    ///< 3×(J+3), at rest in the end, W
  double cost_to_go = 0.0;  ///< of the leaf, m
  double hold_s = 0.0;      ///< terminal clear time, at most to the last interval of `obstacles`, s
  double cost = 0.0;        ///< f of the leaf
  std::int64_t expansions = 0;
  PairCounts pairs;
  std::vector<SearchViewNode> nodes;  ///< the nodes that are clear, in order of expansion, if keep_nodes
};

/// Searches best first in the order (band of the cost-to-go that is still reachable within S, f, depth, index).
///
///  - Nodes are control points q_l with their index l, from q_2 on. A child is q_{l+1} = q_l + v_l Δt.
///  - For children, v_l is sampled uniformly per axis, in the interval that v_max, a_max, j_max and the end at rest
///    allow (AxisReach, StepReach). One more child aims at the goal. If the goal is outside S, and a step may leave
///    S or Δt < kShortInterval, this child aims at the border of S instead.
///  - A node is tested for collision when it is popped, on interval l − 3. A leaf (l = n − 2) is also tested on the
///    two closing intervals, and for its hold.
///  - Leaves are ranked by hold ≥ required, then band of the cost-to-go, then f, then index.
///  - Bands are counted from 0. With dynamics, and a goal outside S, they are counted from the border of S.
///  - The search ends when no open node can win by more than a step of f. It also ends after max_expansions, after
///    hold_expansions from the first leaf on, and with the budget.
///
/// The search is deterministic. Derivations are in docs/planner/search.md.
/// @param obstacles  origin at the start; intervals 0 … J−1 are the plan's, later ones are for the hold
/// @param memory     for a search no larger than an earlier one, only the control points of the result are allocated
SearchResult semantic_a_star(const SearchProblem& problem, const SearchConfig& config, SeparationCache& cache,
                             Budget& budget, SearchMemory& memory);

}  // namespace tern
