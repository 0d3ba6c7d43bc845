// The planner's numbers, in one place. Read from the scenario's `planner:` section by planner/app.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/splines/hull_basis.h"

namespace tern {

enum class SemanticCost { MeanDistance, Exposure };

struct SearchConfig {
  int samples_xy = 3;             ///< velocity samples per horizontal axis and node, 2 … 15
  int samples_z = 3;              ///< on the vertical axis, 2 … 15
  int max_expansions = 1200;      ///< per attempt, 1 … 10⁷
  int hold_expansions = 400;      ///< how many more are spent after the first leaf to find one that holds long enough
  double lambda_g = 1.0;          ///< weight of the path's length, ≥ 0
  double lambda_h = 1.0;          ///< weight of the way to go, ≥ 0
  double band_m = 0.5;            ///< leaves whose way to go lies in one band make equal progress, m
  double cost_step_m = 0.2;       ///< f only counts to this: on the way to a far goal almost every node has the same f
  double prune_position_m = 0.1;  ///< δ: nodes in one voxel of position, index and coarse velocity are one
  double prune_velocity_mps = 1.5;  ///< the coarse velocity
};

/// How Eq. 4 is solved. Alternating: for points with the planes fixed, then the planes anew. Joint: for both together.
enum class OptimizationMethod { SearchOnly, Alternating, Joint, AlternatingThenJoint };
/// Of the convex problem with the planes fixed.
enum class ConvexSolver { Barrier, Ipopt };

struct OptimizationConfig {
  OptimizationMethod method = OptimizationMethod::Alternating;
  ConvexSolver solver = ConvexSolver::Barrier;
  double weight_jerk = 2e-6;   ///< ω_u of Eq. 4, s⁶
  double weight_goal = 1.0;    ///< ω_g of Eq. 4
  int rounds = 1;              ///< solve; more rounds recentre the planes and solve again
  double plane_reach_m = 1.0;  ///< planes nearer than this to the search's path enter the problem, m
  int max_iterations = 60;     ///< of the solver, per round
};

/// The most intervals J of a plan.
inline constexpr int kMaxPlanIntervals = 12;

struct PlannerConfig {
  int intervals = 6;                                            ///< J, 4 … kMaxPlanIntervals
  double sphere_radius_m = 4.0;                                 ///< r
  std::vector<double> duration_scales = {1.1, 1.35, 1.8, 2.6};  ///< T over the per-axis bound, tried in order
  double hold_required_s = 0.5;             ///< an end that stays clear this long is preferred to one that does not
  double hold_cap_s = 1.5;                  ///< how far the hold is followed
  double hold_until_s = 60.0;               ///< a hold is not asked for later than this after t_s
  double stale_after_s = 0.3;               ///< predictions older than this are stale
  double velocity_share = 0.998;            ///< plans stay below this share of v_max
  HullBasis hull_basis = HullBasis::Minvo;  ///< of search and optimizer; the checker's is MINVO
  bool unknown_is_obstacle = false;         ///< unknown voxels of the map
  bool semantics = true;
  SemanticCost semantic_cost = SemanticCost::Exposure;
  double lambda_attractive = 2.0;
  double lambda_repulsive = 2.0;
  std::vector<std::pair<std::string, double>> class_lambdas;  ///< classes with a λ of their own
  bool semantic_path = true;       ///< the path around static obstacles knows regions (by exposure)
  double exposure_margin_m = 1.0;  ///< exposure falls from 1 to 0 within this distance of a region
  double goal_tolerance_m = 0.05;  ///< at rest within this of the goal: nothing to do
  bool publish_search = false;     ///< SEARCH_VIEW with every answer, for people; changes no answer
  SearchConfig search;
  OptimizationConfig optimization;
};

}  // namespace tern
