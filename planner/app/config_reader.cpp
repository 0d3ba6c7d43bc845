#include "planner/app/config_reader.h"

namespace tern {
namespace {

void read_search(ConfigSection section, SearchConfig& c) {
  c.samples_xy = static_cast<int>(section.integer("samples_xy", c.samples_xy, 2, 15));
  c.samples_z = static_cast<int>(section.integer("samples_z", c.samples_z, 2, 15));
  c.max_expansions = static_cast<int>(section.integer("max_expansions", c.max_expansions, 1, 10'000'000));
  c.hold_expansions = static_cast<int>(section.integer("hold_expansions", c.hold_expansions, 0, 10'000'000));
  c.lambda_g = section.number("lambda_g", c.lambda_g, Range::at_least(0.0, 1e3));
  c.lambda_h = section.number("lambda_h", c.lambda_h, Range::at_least(0.0, 1e3));
  c.band_m = section.number("band_m", c.band_m, Range::positive(100.0));
  c.prune_position_m = section.number("prune_position_m", c.prune_position_m, Range{0.01, 10.0});
  c.prune_velocity_mps = section.number("prune_velocity_mps", c.prune_velocity_mps, Range{0.1, 100.0});
  section.finish();
}

OptimizationMethod method_of(const std::string& name) {
  if (name == "search_only") return OptimizationMethod::SearchOnly;
  if (name == "joint") return OptimizationMethod::Joint;
  if (name == "alternating_then_joint") return OptimizationMethod::AlternatingThenJoint;
  return OptimizationMethod::Alternating;
}

HullBasis hull_basis_of(const std::string& name) {
  if (name == "bezier") return HullBasis::Bezier;
  return name == "bspline" ? HullBasis::Bspline : HullBasis::Minvo;
}

void read_optimization(ConfigSection section, OptimizationConfig& c) {
  c.method = method_of(
      section.choice("method", "alternating", {"search_only", "alternating", "joint", "alternating_then_joint"}));
  c.solver = section.choice("solver", "barrier", {"barrier", "ipopt"}) == "ipopt" ? ConvexSolver::Ipopt
                                                                                  : ConvexSolver::Barrier;
  c.weight_jerk = section.number("weight_jerk", c.weight_jerk, Range::positive(1e6));
  c.weight_goal = section.number("weight_goal", c.weight_goal, Range::positive(1e6));
  c.rounds = static_cast<int>(section.integer("rounds", c.rounds, 1, 20));
  c.plane_reach_m = section.number("plane_reach_m", c.plane_reach_m, Range::at_least(0.0, 100.0));
  c.max_iterations = static_cast<int>(section.integer("max_iterations", c.max_iterations, 1, 10'000));
  section.finish();
}

}  // namespace

PlannerConfig read_planner_config(ConfigSection section, const SemanticsSpec& semantics) {
  PlannerConfig c;
  c.intervals = static_cast<int>(section.integer("intervals", c.intervals, 4, kMaxPlanIntervals));
  c.sphere_radius_m = section.number("sphere_radius_m", c.sphere_radius_m, Range{0.1, 1000.0});
  c.duration_scales = section.numbers("duration_scales", c.duration_scales, Range{0.5, 20.0});
  if (c.duration_scales.empty()) throw section.error("duration_scales", "needs at least one number");
  c.hold_required_s = section.number("hold_required_s", c.hold_required_s, Range::at_least(0.0, 10.0));
  c.hold_cap_s = section.number("hold_cap_s", c.hold_cap_s, Range{0.1, 10.0});
  c.hold_until_s = section.number("hold_until_s", c.hold_until_s, Range::at_least(0.0, 60.0));
  c.stale_after_s = section.number("stale_after_s", c.stale_after_s, Range::positive(10.0));
  c.velocity_share = section.number("velocity_share", c.velocity_share, Range{0.1, 1.0});
  c.unknown_is_obstacle = section.choice("unknown", "free", {"free", "obstacle"}) == "obstacle";
  c.hull_basis = hull_basis_of(section.choice("hull_basis", "minvo", {"minvo", "bezier", "bspline"}));
  c.exposure_margin_m = section.number("exposure_margin_m", c.exposure_margin_m, Range::positive(100.0));
  c.goal_tolerance_m = section.number("goal_tolerance_m", c.goal_tolerance_m, Range{0.001, 10.0});
  c.semantics = semantics.enabled;
  c.semantic_path = section.flag("semantic_path", c.semantic_path);
  c.semantic_cost = semantics.cost == "mean_distance" ? SemanticCost::MeanDistance : SemanticCost::Exposure;
  c.lambda_attractive = semantics.lambda_attractive;
  c.lambda_repulsive = semantics.lambda_repulsive;
  c.class_lambdas = semantics.lambdas;
  c.publish_search = section.flag("publish_search", c.publish_search);
  read_search(section.section("search"), c.search);
  read_optimization(section.section("optimization"), c.optimization);
  section.finish();
  if (c.hold_required_s > c.hold_cap_s) throw section.error("hold_required_s", "is more than hold_cap_s");
  return c;
}

}  // namespace tern
