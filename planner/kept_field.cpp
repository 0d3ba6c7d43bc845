#include "planner/kept_field.h"

#include <algorithm>
#include <utility>

namespace tern {
namespace {

/// A side that is nearer than this to a multiple of kFieldStep is one, m: sums of decimal numbers differ by rounding.
constexpr double kRounding = 1e-9;

Box rounded_up(const Box& box) { return rounded_out(box, kFieldStep, kRounding); }

/// Whether body and static boxes change several times a second, or the field takes long.
bool is_rounded(const GoalFieldKey& key) { return key.speed > 0.0 || key.map_margin > 0.0; }

bool is_a_little_larger(const Box& kept, const Box& wanted) {
  return grown(kept, Vec3::Constant(kRounding)).contains(wanted) &&
         grown(wanted, Vec3::Constant(3.0 * kFieldStep)).contains(kept);
}

}  // namespace

KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          std::vector<Box> static_boxes, const Vec3& start) {
  const auto made = [&](const GoalFieldKey& with_body, std::vector<Box> boxes) {
    auto field = std::make_shared<const GoalField>(make_goal_field(with_body, map, boxes, start));
    return KeptField{std::move(field), with_body, std::move(boxes), false};
  };
  if (!is_rounded(key)) return made(key, std::move(static_boxes));
  GoalFieldKey rounded = key;
  rounded.body = rounded_up(key.body);
  std::vector<Box> boxes = static_boxes;
  std::ranges::transform(boxes, boxes.begin(), rounded_up);
  KeptField kept = made(rounded, std::move(boxes));
  if (kept.field->path_from(start)) return kept;
  kept = made(key, std::move(static_boxes));
  kept.is_blocked = !kept.field->path_from(start);
  return kept;
}

KeptField make_kept_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const PathObstacles& obstacles, const Vec3& start) {
  KeptField kept = make_kept_field(key, map, obstacles.all(), start);
  const bool has_resting = !obstacles.resting.empty(), has_margin = key.map_margin > 0.0;
  if ((!has_resting && !has_margin) || kept.field->path_from(start)) return kept;
  const auto opens = [&](double map_margin, const std::vector<Box>& boxes) {
    GoalFieldKey tried = key;
    tried.map_margin = map_margin;
    kept = make_kept_field(tried, map, boxes, start);
    return kept.field->path_from(start).has_value();
  };
  if (!(has_resting && opens(key.map_margin, obstacles.fixed)) && has_margin) {
    (void)(opens(0.0, obstacles.all()) || opens(0.0, obstacles.fixed));
  }
  kept.key = key;
  kept.static_boxes = obstacles.all();
  kept.is_blocked = true;
  return kept;
}

bool serves(const KeptField& kept, const GoalFieldKey& wanted, const std::vector<Box>& static_boxes) {
  if (kept.key == wanted) return true;
  if (kept.is_blocked || !is_rounded(wanted)) return false;
  GoalFieldKey key = wanted;
  key.body = kept.key.body;
  key.statics = kept.key.statics;
  return key == kept.key && is_a_little_larger(kept.key.body, wanted.body) &&
         std::ranges::equal(kept.static_boxes, static_boxes, is_a_little_larger);
}

}  // namespace tern
