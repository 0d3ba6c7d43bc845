#include "planner/app/blocked_goal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/world/body.h"
#include "core/world/names.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Boxes are equal within kPathSpacing: a box that contains goal or start was shrunk a little.
bool are_same(const Box& a, const Box& b) {
  const Vec3 apart = (a.min() - b.min()).cwiseAbs().cwiseMax((a.max() - b.max()).cwiseAbs());
  return apart.maxCoeff() <= kPathSpacing;
}

/// Returns whether a region reaches into a box. It samples kParts³ points of the intersection of their bounds.
bool reaches_into(const Region& region, const Box& box) {
  constexpr int kParts = 8;
  const Box both = region.bounds().intersection(box);
  if (both.isEmpty()) return false;
  const Vec3 part = both.sizes() / kParts;
  for (int k = 0; k < kParts * kParts * kParts; ++k) {
    const Eigen::Vector3i index(k % kParts, k / kParts % kParts, k / (kParts * kParts));
    if (region.contains(both.min() + part.cwiseProduct(index.cast<double>() + Vec3::Constant(0.5)))) return true;
  }
  return false;
}

/// Returns the names of the box: "obstacle 'post'" or "region 'left', region 'back'"; "" if it has none.
std::string names_of(const Box& box, bool is_obstacle, const std::vector<NamedPlace>& places) {
  constexpr std::size_t kMaxNamed = 3;
  std::vector<std::string> names;
  for (const NamedPlace& place : places) {
    if (place.is_obstacle != is_obstacle || names.size() >= kMaxNamed) continue;
    const bool is_it = is_obstacle ? are_same(place.where.bounds(), box) : reaches_into(place.where, box);
    if (is_it) names.push_back(fmt::format("{} '{}'", is_obstacle ? "obstacle" : "region", place.where.name));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<NamedPlace> named_places(const Scenario& scenario) {
  std::vector<NamedPlace> places;
  for (const ObstacleSpec& o : scenario.world.obstacles) {
    if (o.name.empty() || !std::holds_alternative<StaticMotion>(o.motion)) continue;
    places.push_back({true, {o.name, "", box_around(o.centre, o.half_extents)}});
  }
  for (const Region& region : scenario.semantics.regions) {
    const auto& classes = scenario.semantics.classes;
    const bool is_occupied = std::ranges::any_of(classes, [&](const auto& c) {
      return c.first == region.class_name && c.second == to_string(VoxelLabel::Occupied);
    });
    if (is_occupied) places.push_back({false, region});
  }
  return places;
}

std::string blocked_goal_text(const GoalField& field, const GoalFieldKey& key, const std::vector<Box>& static_boxes,
                              const Vec3& start, const std::vector<NamedPlace>& places) {
  if (!places_within(key.flight_box, key.body).contains(key.goal)) return "it is not within the flight box";
  const auto blocker = field.blocker(start);
  if (!blocker) return "no path within the flight box leads to it";
  const Vec3 spacing = Vec3::Constant(kPathSpacing);
  const Box box(blocker->min() + key.body.max() + spacing, blocker->max() + key.body.min() - spacing);
  const bool is_static = std::ranges::any_of(static_boxes, [&](const Box& b) { return are_same(b, box); });
  const std::string names = names_of(box, is_static, places);
  const std::string what = is_static       ? (names.empty() ? "an obstacle" : names)
                           : names.empty() ? "an occupied part of the map"
                                           : fmt::format("an occupied part of the map ({})", names);
  const auto place = [](const Vec3& p) {
    const Vec3 r = (p * 100.0).array().round() / 100.0 + 0.0;  // never -0.00
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", r.x(), r.y(), r.z());
  };
  return fmt::format("{} from {} to {} {}", what, place(box.min()), place(box.max()),
                     blocker->contains(key.goal) ? "leaves no room at the goal" : "is the first to block the way");
}

}  // namespace tern
