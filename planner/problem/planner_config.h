// The planner's keys: the scenario's `planner:` section. Each key's meaning stands at its entry in visit().
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/knobs.h"
#include "core/splines/hull_basis.h"
#include "planner/problem/landmark_priors.h"
#include "planner/unseen/unseen_movers.h"

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
  double cost_step_m = 0.2;  ///< f is compared in steps of this: far from the goal almost all nodes have the same f, m
  double prune_position_m = 0.1;  ///< δ
  double prune_velocity_mps = 1.5;

  template <typename V>
  void visit(V& v) {
    v("samples_xy", samples_xy, Range{2, 15}, "velocities sampled per horizontal axis and node");
    v("samples_z", samples_z, Range{2, 15}, "velocities sampled on the vertical axis");
    v("max_expansions", max_expansions, Range{1, 1e7}, "limit of nodes expanded per duration");
    v("hold_expansions", hold_expansions, Range{0, 1e7},
      "limit of nodes expanded after the first leaf, to find one that holds");
    v("lambda_g", lambda_g, Range{0.0, 1e3}, "weight of the path's length in f (Eq. 2)");
    v("lambda_h", lambda_h, Range{0.0, 1e3}, "weight of the cost-to-go in f (Eq. 2)");
    v("band_m", band_m, Range::positive(100.0),
      "leaves whose cost-to-go lies in one band of this width make equal progress, m");
    v("prune_position_m", prune_position_m, Range{0.01, 10.0},
      "two nodes of one index are merged if their positions differ by less than this, m, and their velocities by less "
      "than `search.prune_velocity_mps`");
    v("prune_velocity_mps", prune_velocity_mps, Range{0.1, 100.0},
      "difference of velocities for `search.prune_position_m`, m/s");
  }
};

/// How Eq. 4 is solved. Alternating: for the points with fixed planes, then new planes. Joint: for both together.
enum class OptimizationMethod { SearchOnly, Alternating, Joint, AlternatingThenJoint };
/// The solver of the convex problem with fixed planes.
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
      "how Eq. 4 is solved; search_only leaves it out");
    v("solver", solver, KnobWords<ConvexSolver>{{"barrier", ConvexSolver::Barrier}, {"ipopt", ConvexSolver::Ipopt}},
      "solver of the convex problem with fixed planes");
    v("weight_jerk", weight_jerk, Range::positive(1e6), "ω_u of Eq. 4, s⁶");
    v("weight_goal", weight_goal, Range::positive(1e6), "ω_g of Eq. 4");
    v("rounds", rounds, Range{1, 20}, "number of solves; planes are recentred between two");
    v("plane_reach_m", plane_reach_m, Range{0.0, 100.0},
      "obstacles, limits and bounds nearer than this to the search's trajectory enter the problem, m");
    v("max_iterations", max_iterations, Range{1, 1e4}, "limit of the solver's iterations per round");
  }
};

/// The largest J.
inline constexpr int kMaxPlanIntervals = 12;

/// Where the vehicle looks: in the direction of flight (the executor decides), or where a planned heading points.
enum class HeadingMode { Along, Planned };

/// The section `planner.semantics`.
struct ErrorPriceConfig {
  double error_price = 0.0;
  bool learn_densities = false;
  LandmarkPriors landmarks;
  template <typename V>
  void visit(V& v) {
    v("error_price", error_price, Range{0.0, 1e4},
      "metres of way that one metre of the position's σ is worth, at the goal and at the worst place; 0: λ applies");
    v("learn_densities", learn_densities,
      "with `error_price`: the densities in `landmarks` are corrected by what FEATURE_TRACKS show");
    v("landmarks", landmarks);
  }
};

struct PlannerConfig {
  int intervals = 6;             ///< J
  double sphere_radius_m = 4.0;  ///< r
  std::vector<double> duration_scales = {1.1, 1.35, 1.8, 2.6};
  double hold_required_s = 0.5;
  double hold_cap_s = 1.5;
  double stale_after_s = 0.3;
  double velocity_share = 0.998;
  HullBasis hull_basis = HullBasis::Minvo;  ///< in search and optimizer; the checker uses MINVO
  bool unknown_is_obstacle = false;         ///< unknown voxels of the map are obstacles
  bool semantics = true;                    ///< from the scenario's `semantics:`, like the cost and every λ
  SemanticCost semantic_cost = SemanticCost::Exposure;
  double lambda_attractive = 2.0;
  double lambda_repulsive = 2.0;
  std::vector<std::pair<std::string, double>> class_lambdas;  ///< class name and its own λ
  bool semantic_path = true;
  double exposure_margin_m = 1.0;
  double goal_tolerance_m = 0.05;
  bool publish_search = false;
  HeadingMode heading = HeadingMode::Along;
  UnseenMode unseen = UnseenMode::Ignore;
  UnseenMovers unseen_movers;
  SearchConfig search;
  OptimizationConfig optimization;
  ErrorPriceConfig error_price;

  template <typename V>
  void visit(V& v) {
    v("intervals", intervals, Range{4, kMaxPlanIntervals}, "number J of polynomial pieces of a plan");
    v("sphere_radius_m", sphere_radius_m, Range{0.1, 1000.0},
      "radius r of the sphere S about the start, in which a plan stays, m");
    v("duration_scales", duration_scales, Range{0.5, 20.0},
      "durations as multiples of the time-optimal bound, tried in order");
    v("hold_required_s", hold_required_s, Range{0.0, 10.0},
      "required hold: an end that stays clear this long is preferred, s. At most half the prediction horizon; plan and "
      "hold together last at least the vehicle's side-step time");
    v("hold_cap_s", hold_cap_s, Range{0.1, 10.0},
      "for how long a hold is tested, s; capped at half the prediction horizon; ≥ `hold_required_s`");
    v("stale_after_s", stale_after_s, Range::positive(10.0), "predictions older than this are stale, s");
    v("velocity_share", velocity_share, Range{0.1, 1.0}, "plans stay below this share of v_max");
    v("unknown", unknown_is_obstacle, KnobWords<bool>{{"free", false}, {"obstacle", true}},
      "how unknown voxels of the map count");
    v("hull_basis", hull_basis,
      KnobWords<HullBasis>{{"minvo", HullBasis::Minvo}, {"bezier", HullBasis::Bezier}, {"bspline", HullBasis::Bspline}},
      "basis whose hull points represent the curve in search and optimizer; the checker uses MINVO");
    v("exposure_margin_m", exposure_margin_m, Range::positive(100.0),
      "exposure decreases from 1 to 0 within this distance of a region, m");
    v("goal_tolerance_m", goal_tolerance_m, Range{0.001, 10.0},
      "a vehicle at rest within this distance of the goal has reached it, m");
    v("semantic_path", semantic_path,
      "the path to the goal includes the exposure cost of regions; false: only plans within S do");
    v("publish_search", publish_search,
      "publish SEARCH_VIEW after each answer: the nodes of the last search, for tern-viewer. Answers are the same");
    v("heading", heading, KnobWords<HeadingMode>{{"along", HeadingMode::Along}, {"planned", HeadingMode::Planned}},
      "where the vehicle looks: along its flight, or where PLAN_HEADING points, which is then sent with each plan");
    v("unseen", unseen, KnobWords<UnseenMode>{{"ignore", UnseenMode::Ignore}, {"passive", UnseenMode::Passive}},
      "passive: plans come to rest before a mover that no sensor has seen can touch the vehicle, as far as "
      "OBSTACLE_SIGHTINGS show");
    v("unseen_movers", unseen_movers);
    v("search", search);
    v("optimization", optimization);
    v("semantics", error_price);
  }
};

}  // namespace tern
