#include "planner/app/config_reader.h"

#include "planner/optimization/ipopt_solver.h"
#include "runtime/class_densities.h"

namespace tern {
namespace {

/// Returns the key that asks for Ipopt, or null.
const char* key_for_ipopt(const OptimizationConfig& config) {
  switch (config.method) {
    case OptimizationMethod::SearchOnly: return nullptr;
    case OptimizationMethod::Alternating: return config.solver == ConvexSolver::Ipopt ? "optimization.solver" : nullptr;
    case OptimizationMethod::Joint:
    case OptimizationMethod::AlternatingThenJoint: break;
  }
  return "optimization.method";
}

}  // namespace

PlannerConfig read_planner_config(ConfigSection section, const SemanticsSpec& semantics) {
  PlannerConfig c;
  LandmarkPriors& priors = c.error_price.landmarks;
  priors.regions = read_class_densities(section.section("semantics").section("landmarks").section("regions"),
                                        priors.regions, LandmarkPriors::kMaxDensity,
                                        "expected landmarks per m² in regions of this class; others have the ground's");
  section.read(c);
  c.semantics = semantics.enabled;
  c.semantic_cost = semantics.cost == "mean_distance" ? SemanticCost::MeanDistance : SemanticCost::Exposure;
  c.lambda_attractive = semantics.lambda_attractive;
  c.lambda_repulsive = semantics.lambda_repulsive;
  c.class_lambdas = semantics.lambdas;
  if (c.duration_scales.empty()) throw section.error("duration_scales", "needs at least one number");
  if (c.hold_required_s > c.hold_cap_s) throw section.error("hold_required_s", "is more than hold_cap_s");
  if (const char* key = key_for_ipopt(c.optimization); key != nullptr && !why_no_ipopt().empty()) {
    throw section.error(key, "needs Ipopt. " + why_no_ipopt());
  }
  return c;
}

}  // namespace tern
