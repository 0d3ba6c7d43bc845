#include "planner/planning_world.h"

#include <string_view>
#include <utility>

#include "core/base/digest.h"
#include "planner/global_path/box_cover.h"

namespace tern {
namespace {

/// Paths keep this far from static obstacles, m, where that leaves a way: flights by hulls need a little room.
constexpr double kPathSpacing = 0.02;

std::uint64_t digest_of(const Box& box, std::uint64_t seed) {
  const double numbers[6] = {box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()};
  return digest({reinterpret_cast<const char*>(numbers), sizeof(numbers)}, seed);
}

}  // namespace

PredictionProducts::PredictionProducts(TrackSet tracks) : set(std::move(tracks)) {
  static_digest = kDigestSeed;
  for (const Track& track : set.tracks) {
    const UTime from = track.motion.start;
    const Box box = track.bounds(from, track.motion.end() + kTrackBoxReach);
    obstacles.push_back({track.id, &track, box, 1.0});
    if (track.kind != TrackKind::Static) continue;
    static_boxes.push_back(box);
    static_digest = digest_of(box, static_digest);
  }
}

MapProducts::MapProducts(const VoxelMap& map, const PlannerConfig& config)
    : version(map.version), occupied(cover_with_boxes(map, config.unknown_is_obstacle)) {
  if (!config.semantics) return;
  SemanticFieldsOptions options;
  options.exposure_margin = config.exposure_margin_m;
  fields = SemanticFields(map, options);
}

Box centre_box(const Box& flight_box, const Body& body) { return grown(flight_box, -body.half_extents()); }

GoalProducts::GoalProducts(const Goal& goal_in, const MapProducts& map, const PredictionProducts& predictions,
                           const Body& body, const Box& flight_box_in, const Vec3& start)
    : goal(goal_in), map_version(map.version), static_digest(predictions.static_digest),
      body_half(body.half_extents()), flight_box(flight_box_in) {
  std::vector<Box> boxes = predictions.static_boxes;
  boxes.insert(boxes.end(), map.occupied.boxes().begin(), map.occupied.boxes().end());
  const Vec3 inflation = body_half + Vec3::Constant(kPathSpacing);
  for (Box& box : boxes) box = grown(box, inflation);
  GoalFieldOptions options;
  options.start = start;
  field = GoalField::build(std::move(boxes), centre_box(flight_box, body), goal.position, options);
}

}  // namespace tern
