#include "planner/planning_world.h"

#include <algorithm>
#include <utility>

#include "core/splines/piecewise_cubic.h"
#include "core/world/body.h"
#include "core/world/box_cover.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

/// Nodes of a field whose costs are priced: each costs some times more than by length alone.
constexpr std::int64_t kPricedNodes = 60'000;
/// An obstacle that would arrive later than this counts as one that never arrives.
constexpr Duration kMaxArrivalTime{1'000'000'000'000};

/// Returns the track's box over one piece, as Track::bounds() does.
Box piece_box(const Track& track, std::size_t k) {
  const CubicPiece& piece = track.motion.pieces[k];
  return grown(cubic_bounds(piece.coefficients, 0.0, piece.duration.seconds()), track.half_extents + track.alpha[k]);
}

/// The places of which information is prepared: the textures with kAroundTexture, start and goal, in the flight box.
Box informed_region(const SurfaceMap& surfaces, const GoalFieldKey& key, const Vec3& start) {
  Box region(key.goal);
  region.extend(start);
  if (!surfaces.extent().isEmpty()) region.extend(surfaces.extent());
  return grown(region, Vec3(kAroundTexture, kAroundTexture, 0.0)).intersection(key.flight_box);
}

/// Returns the heights at which information is prepared: of goal, start and the highest place, and half-way up to it.
std::vector<double> informed_heights(double goal, double start, const Box& region) {
  const double high = std::max(goal, start), top = std::min(region.max().z(), high + kHigherPlaces);
  std::vector<double> heights;
  for (const double z : {std::min(goal, start), high, 0.5 * (high + top), top}) {
    if (heights.empty() || z > heights.back() + kLeastLayer) heights.push_back(z);
  }
  return heights;
}

TravelCost priced_way(const GoalFieldKey& key, const MapProducts& map, const std::vector<Box>& static_boxes,
                      const Vec3& start) {
  const SurfaceMap surfaces =
      (key.densities ? map.surfaces.with_densities(*key.densities) : map.surfaces).with_obstacles(static_boxes);
  const Box region = informed_region(surfaces, key, start);
  if (region.isEmpty()) return {};
  const auto information =
      std::make_shared<const InformationMap>(surfaces, region, informed_heights(key.goal.z(), start.z(), region));
  TravelCost cost;
  cost.region = region;
  cost.information = information;
  cost.priced = [price = ErrorPrice(information, map.error_price, key.speed)](
                    const Vec3& a, const Vec3& b, Drift& drift) { return price.extend(a, b, drift); };
  return cost;
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
  error_price = config.error_price.error_price;
  if (error_price > 0.0) {  // it replaces every λ
    surfaces = SurfaceMap(map, config.error_price.landmarks);
    class_names = map.class_names;
    return;
  }
  SemanticFieldsOptions options;
  options.exposure_margin = config.exposure_margin_m;
  options.lambda_attractive = config.lambda_attractive;
  options.lambda_repulsive = config.lambda_repulsive;
  options.class_lambdas = config.class_lambdas;
  fields = SemanticFields(map, options);
  semantic_paths = config.semantic_path && fields.has_weight();
}

double way_speed(const MapProducts& map, const Limits& limits) {
  return map.error_price > 0.0 ? kCruiseShare * std::min(limits.v_max.x(), limits.v_max.y()) : 0.0;
}

GoalField make_goal_field(const GoalFieldKey& key, const std::shared_ptr<const MapProducts>& map,
                          const std::vector<Box>& static_boxes, const Vec3& start) {
  std::vector<Box> boxes = static_boxes;
  for (const Box& box : map->occupied.boxes()) boxes.push_back(grown(box, Vec3::Constant(key.map_margin)));
  for (Box& box : boxes) {
    const Box solid = places_at(box, key.body);
    box = grown(solid, Vec3::Constant(kPathSpacing));
    if (!solid.contains(key.goal)) box = core_beyond(box, key.goal);  // so that a goal beside a wall can be reached
  }
  GoalFieldOptions options;
  options.start = start;
  if (map->semantic_paths) {
    options.cost.extra = [map](const Vec3& a, const Vec3& b) { return map->fields.exposure_cost(a, b); };
    options.cost.region = map->fields.influence();
  }
  if (map->error_price > 0.0) {
    options.cost = priced_way(key, *map, static_boxes, start);
    options.max_nodes = kPricedNodes;
  }
  return GoalField::build(std::move(boxes), places_within(key.flight_box, key.body), key.goal, options);
}

std::optional<ForetoldError> foretell_error(const GoalField& field, const Vec3& start, double speed) {
  if (!field.cost().information) return std::nullopt;
  const auto path = field.path_from(start);
  if (!path) return std::nullopt;
  return foretell_error(*path, speed, *field.cost().information);
}

}  // namespace tern
