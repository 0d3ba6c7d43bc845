#include "planner/kept_field.h"

#include <cmath>

namespace tern {
namespace {

/// Each side of a body farther out, to the next multiple of kBodyStep.
Box rounded_up(const Box& body) {
  const auto outwards = [](double x) { return kBodyStep * std::ceil(x / kBodyStep - 1e-9); };
  return {-(-body.min()).unaryExpr(outwards), body.max().unaryExpr(outwards)};
}

}  // namespace

KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start) {
  const auto made_for = [&](const GoalFieldKey& k) {
    return KeptField{std::make_shared<const GoalField>(make_goal_field(k, map, static_boxes, start)), k};
  };
  if (!(map->error_price > 0.0)) return made_for(key);
  GoalFieldKey rounded = key;
  rounded.body = rounded_up(key.body);
  KeptField kept = made_for(rounded);
  return kept.field->path_from(start) ? kept : made_for(key);
}

bool serves(const GoalFieldKey& made_for, const GoalFieldKey& wanted) {
  if (made_for == wanted) return true;
  if (!(made_for.speed > 0.0)) return false;
  GoalFieldKey with_wanted_body = made_for;
  with_wanted_body.body = wanted.body;
  return with_wanted_body == wanted && made_for.body.contains(wanted.body) &&
         grown(wanted.body, Vec3::Constant(3.0 * kBodyStep)).contains(made_for.body);
}

}  // namespace tern
