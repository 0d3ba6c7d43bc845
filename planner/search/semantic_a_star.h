// Semantic A* over control points (paper §4, Algorithm 1, its slips mended: docs/paper_gaps.md).
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

/// The cost-to-go from p: |p − point| + rest, m. `point` is the next corner of the path around static obstacles.
struct CostToGo {
  Vec3 point = Vec3::Zero();
  double rest = 0.0;
  [[nodiscard]] double from(const Vec3& p) const { return (p - point).norm() + rest; }
  /// The least cost-to-go from anywhere in a box.
  [[nodiscard]] double from(const Box& box) const { return box.exteriorDistance(point) + rest; }
};

/// The semantic share of a step between two control points, ≥ 0 or signed; added to f (Eq. 2). Empty: no semantics.
using StepCost = std::function<double(const Vec3& from, const Vec3& to)>;

/// From the start to a leaf that comes as near to the goal as it can, by plan_limits. Where the start moves faster than
/// those allow, the first velocities may too, up to limits.v_max.
struct SearchProblem : HorizonProblem {
  CostToGo cost_to_go = {};
  StepCost accumulated = {};                          ///< summed along the path (exposure)
  std::function<double(const Vec3&)> pointwise = {};  ///< of a node alone: λ_att C_att − λ_rep C_rep (mean_distance)
  double hold_required_s = 0.5;
  bool keep_nodes = false;  ///< for people; changes nothing else
};

struct SearchResult {
  bool found = false;
  Points control_points;    ///< 3×(J+3), ends at rest
  double cost_to_go = 0.0;  ///< of the leaf, m
  double hold_s = 0.0;      ///< clear time at the end point, up to what `obstacles` covers
  double cost = 0.0;        ///< f of the leaf
  std::int64_t expansions = 0;
  PairCounts pairs;
  std::vector<SearchViewNode> nodes;  ///< what was found clear, in that order, if they are kept
};

/// Best-first over (hold, band of the cost-to-go that is still reachable within S, f, index).
///
/// Nodes are control points q_l with their index l, from q_2 on. A child is q_{l+1} = q_l + v_l (t_{l+4} − t_{l+1})/3.
/// Its velocity control point v_l is sampled uniformly per axis in the interval that v_max, a_max, j_max and the end at
/// rest leave (AxisReach). One child aims at the goal, or, where a first step may leave S or Δt is a moment, at where
/// the way leaves S. A node is tested for collision when it is popped: interval l−3, at a leaf (l = n−2) also the two
/// closing intervals. Leaves are ranked: hold ≥ required first, then the band of the cost-to-go, then f. Bands are
/// counted from 0; with dynamics, where the way leads out of S, from its border. The search ends when no open node can
/// still win (by more than a step of f), or after max_expansions. It also ends hold_expansions after the first leaf, or
/// with the budget. Ties by depth, f and index: deterministic.
/// @param obstacles  origin at the start, intervals 0 … J−1 the plan's, the others after its end for the hold.
/// @param memory     used again from call to call: a search as large as an earlier one allocates only its result's
/// control points.
SearchResult semantic_a_star(const SearchProblem& problem, const SearchConfig& config, SweptObstacles& obstacles,
                             Budget& budget, SearchMemory& memory);

}  // namespace tern
