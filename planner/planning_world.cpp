#include "planner/planning_world.h"

#include <algorithm>
#include <utility>

#include "core/splines/piecewise_cubic.h"
#include "core/world/body.h"
#include "core/world/box_cover.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// An obstacle that would arrive later than this counts as one that never arrives.
constexpr Duration kMaxArrivalTime{1'000'000'000'000};

/// Returns the track's box over one piece, as Track::bounds() does.
Box piece_box(const Track& track, std::size_t k) {
  const CubicPiece& piece = track.motion.pieces[k];
  return grown(cubic_bounds(piece.coefficients, 0.0, piece.duration.seconds()), track.half_extents + track.alpha[k]);
}

}  // namespace

PredictionProducts::PredictionProducts(TrackSet tracks) : set(std::move(tracks)) {
  std::size_t pieces = 0;
  std::size_t movers = 0;
  for (const Track& track : set.tracks) {
    if (track.kind == TrackKind::Static) continue;
    pieces += track.motion.pieces.size();
    ++movers;
  }
  piece_boxes.reserve(pieces);
  movers_.reserve(movers);
  obstacles.reserve(set.tracks.size());
  std::vector<Box> boxes;
  boxes.reserve(set.tracks.size());
  for (const Track& track : set.tracks) {
    boxes.push_back(track.bounds(track.motion.start, track.motion.end() + kTrackBoxReach));
    obstacles.push_back({track.id, &track, boxes.back(), {}});
    if (track.kind != TrackKind::Static) obstacles.back().boxes = &add_mover(track).boxes;
  }
  index = BoxIndex(std::move(boxes));
}

const PredictionProducts::Mover& PredictionProducts::add_mover(const Track& track) {
  const std::size_t first = piece_boxes.size();
  Box whole;
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    piece_boxes.push_back(piece_box(track, k));
    whole.extend(piece_boxes.back());
  }
  const std::span<const Box> made(piece_boxes.data() + first, piece_boxes.size() - first);
  return movers_.emplace_back(Mover{{whole, track.motion.end(), made}, track.top_speed});
}

Foresight PredictionProducts::foresight(const Box& region) const {
  Foresight foresight;
  for (const Mover& mover : movers_) {
    const MotionBoxes& boxes = mover.boxes;
    const Vec3 gaps = (boxes.whole.min() - region.max()).cwiseMax(region.min() - boxes.whole.max());
    const double gap = std::max(0.0, gaps.maxCoeff());
    if (gap > mover.top_speed * kMaxArrivalTime.seconds()) continue;
    const Duration grows{gap > 0.0 ? static_cast<std::int64_t>(gap / mover.top_speed * 1e6) : 0};
    foresight.predicted_until = std::min(foresight.predicted_until, boxes.end + grows);
    foresight.followed_until = std::min(foresight.followed_until, boxes.end + std::max(grows, kTrackBoxReach));
  }
  return foresight;
}

MapProducts::MapProducts(const VoxelMap& map, const PlannerConfig& config)
    : version(map.version), occupied(cover_with_boxes(map, config.unknown_is_obstacle)) {
  if (!config.semantics) return;
  SemanticFieldsOptions options;
  options.exposure_margin = config.exposure_margin_m;
  options.lambda_attractive = config.lambda_attractive;
  options.lambda_repulsive = config.lambda_repulsive;
  options.class_lambdas = config.class_lambdas;
  fields = SemanticFields(map, options);
  semantic_paths = config.semantic_path && fields.has_weight();
}

GoalField make_goal_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start) {
  std::vector<Box> boxes = static_boxes;
  boxes.insert(boxes.end(), map->occupied.boxes().begin(), map->occupied.boxes().end());
  for (Box& box : boxes) {
    const Box solid = places_at(box, key.body);
    box = grown(solid, Vec3::Constant(kPathSpacing));
    if (!solid.contains(key.goal)) box = core_beyond(box, key.goal);  // so that a goal beside a wall can be reached
  }
  GoalFieldOptions options;
  options.start = start;
  if (map->semantic_paths) {
    options.cost = {[map](const Vec3& a, const Vec3& b) { return map->fields.exposure_cost(a, b); },
                    map->fields.influence()};
  }
  return GoalField::build(std::move(boxes), places_within(key.flight_box, key.body), key.goal, options);
}

}  // namespace tern
