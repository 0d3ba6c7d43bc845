#include "planner/app/config_reader.h"

namespace tern {

PlannerConfig read_planner_config(ConfigSection section, const SemanticsSpec& semantics) {
  PlannerConfig c;
  section.read(c);
  c.semantics = semantics.enabled;
  c.semantic_cost = semantics.cost == "mean_distance" ? SemanticCost::MeanDistance : SemanticCost::Exposure;
  c.lambda_attractive = semantics.lambda_attractive;
  c.lambda_repulsive = semantics.lambda_repulsive;
  c.class_lambdas = semantics.lambdas;
  if (c.duration_scales.empty()) throw section.error("duration_scales", "needs at least one number");
  if (c.hold_required_s > c.hold_cap_s) throw section.error("hold_required_s", "is more than hold_cap_s");
  return c;
}

}  // namespace tern
