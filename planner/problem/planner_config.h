// The planner's knobs, in one place: the scenario's `planner:` section.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/knobs.h"
#include "core/splines/hull_basis.h"

namespace tern {

enum class SemanticCost { MeanDistance, Exposure };

struct SearchConfig {
  int samples_xy = 3;
  int samples_z = 3;
  int max_expansions = 1200;
  int hold_expansions = 400;
  double lambda_g = 1.0;
  double lambda_h = 1.0;
  double band_m = 0.5;
  double cost_step_m = 0.2;       ///< f only counts to this: on the way to a far goal almost every node has the same f
  double prune_position_m = 0.1;  ///< δ
  double prune_velocity_mps = 1.5;

  template <typename V>
  void visit(V& v) {
    v("samples_xy", samples_xy, Range{2, 15}, "velocities per horizontal axis and node");
    v("samples_z", samples_z, Range{2, 15}, "velocities on the vertical axis");
    v("max_expansions", max_expansions, Range{1, 1e7}, "nodes expanded per duration");
    v("hold_expansions", hold_expansions, Range{0, 1e7}, "spent after the first leaf to find one that holds");
    v("lambda_g", lambda_g, Range{0.0, 1e3}, "weight of the path's length in f (Eq. 2)");
    v("lambda_h", lambda_h, Range{0.0, 1e3}, "weight of the way to go in f (Eq. 2)");
    v("band_m", band_m, Range::positive(100.0), "leaves whose way to go lies in one band make equal progress, m");
    v("prune_position_m", prune_position_m, Range{0.01, 10.0}, "nodes of one index this near, m, and …");
    v("prune_velocity_mps", prune_velocity_mps, Range{0.1, 100.0}, "… of velocities this near, m/s, are one");
  }
};

/// How Eq. 4 is solved. Alternating: for points with the planes fixed, then the planes anew. Joint: for both together.
enum class OptimizationMethod { SearchOnly, Alternating, Joint, AlternatingThenJoint };
/// Of the convex problem with the planes fixed.
enum class ConvexSolver { Barrier, Ipopt };

struct OptimizationConfig {
  OptimizationMethod method = OptimizationMethod::Alternating;
  ConvexSolver solver = ConvexSolver::Barrier;
  double weight_jerk = 2e-6;
  double weight_goal = 1.0;
  int rounds = 1;
  double plane_reach_m = 1.0;
  int max_iterations = 60;

  template <typename V>
  void visit(V& v) {
    v("method", method,
      KnobWords<OptimizationMethod>{{"search_only", OptimizationMethod::SearchOnly},
                                    {"alternating", OptimizationMethod::Alternating},
                                    {"joint", OptimizationMethod::Joint},
                                    {"alternating_then_joint", OptimizationMethod::AlternatingThenJoint}},
      "how Eq. 4 is solved; search_only: not at all");
    v("solver", solver, KnobWords<ConvexSolver>{{"barrier", ConvexSolver::Barrier}, {"ipopt", ConvexSolver::Ipopt}},
      "of the convex problem with fixed planes");
    v("weight_jerk", weight_jerk, Range::positive(1e6), "ω_u of Eq. 4, s⁶");
    v("weight_goal", weight_goal, Range::positive(1e6), "ω_g of Eq. 4");
    v("rounds", rounds, Range{1, 20}, "solves; between two the planes are recentred");
    v("plane_reach_m", plane_reach_m, Range{0.0, 100.0},
      "what is nearer than this to the search's trajectory enters the problem, m");
    v("max_iterations", max_iterations, Range{1, 1e4}, "of the solver, per round");
  }
};

/// The most intervals J of a plan.
inline constexpr int kMaxPlanIntervals = 12;

struct PlannerConfig {
  int intervals = 6;             ///< J
  double sphere_radius_m = 4.0;  ///< r
  std::vector<double> duration_scales = {1.1, 1.35, 1.8, 2.6};
  double hold_required_s = 0.5;
  double hold_cap_s = 1.5;
  double stale_after_s = 0.3;
  double velocity_share = 0.998;
  HullBasis hull_basis = HullBasis::Minvo;  ///< of search and optimizer; the checker's is MINVO
  bool unknown_is_obstacle = false;         ///< unknown voxels of the map
  bool semantics = true;                    ///< this, the λ and the cost come from the scenario's `semantics:`
  SemanticCost semantic_cost = SemanticCost::Exposure;
  double lambda_attractive = 2.0;
  double lambda_repulsive = 2.0;
  std::vector<std::pair<std::string, double>> class_lambdas;  ///< classes with a λ of their own
  bool semantic_path = true;
  double exposure_margin_m = 1.0;
  double goal_tolerance_m = 0.05;
  bool publish_search = false;
  SearchConfig search;
  OptimizationConfig optimization;

  template <typename V>
  void visit(V& v) {
    v("intervals", intervals, Range{4, kMaxPlanIntervals}, "J, polynomial pieces of a plan");
    v("sphere_radius_m", sphere_radius_m, Range{0.1, 1000.0}, "r of S, how far from the vehicle a plan may lead, m");
    v("duration_scales", duration_scales, Range{0.5, 20.0}, "durations over the time-optimal bound, tried in order");
    v("hold_required_s", hold_required_s, Range{0.0, 10.0},
      "an end that stays clear so long is preferred to one that does not, s; a vehicle that needs longer to step aside "
      "asks for that. Where movers are predicted for less than twice that, half of what is predicted is asked for");
    v("hold_cap_s", hold_cap_s, Range{0.1, 10.0},
      "how far the hold is followed at least, the same half at most, s; ≥ `hold_required_s`");
    v("stale_after_s", stale_after_s, Range::positive(10.0), "predictions older than this are stale, s");
    v("velocity_share", velocity_share, Range{0.1, 1.0}, "plans stay below this share of v_max");
    v("unknown", unknown_is_obstacle, KnobWords<bool>{{"free", false}, {"obstacle", true}},
      "unknown voxels of the map");
    v("hull_basis", hull_basis,
      KnobWords<HullBasis>{{"minvo", HullBasis::Minvo}, {"bezier", HullBasis::Bezier}, {"bspline", HullBasis::Bspline}},
      "whose hulls stand for the curve in search and optimizer; the checker's are MINVO");
    v("exposure_margin_m", exposure_margin_m, Range::positive(100.0),
      "exposure falls from 1 to 0 within this distance of a region, m");
    v("goal_tolerance_m", goal_tolerance_m, Range{0.001, 10.0}, "at rest within this of the goal: nothing to do, m");
    v("semantic_path", semantic_path,
      "the path to the goal knows regions too, by their exposure cost; false: only what lies within S");
    v("publish_search", publish_search,
      "SEARCH_VIEW after each answer: the nodes of the last search, for tern-viewer; changes no answer");
    v("search", search);
    v("optimization", optimization);
  }
};

}  // namespace tern
