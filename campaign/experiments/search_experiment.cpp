#include "campaign/experiments/search_experiment.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "campaign/flight_inputs.h"
#include "core/geometry/separation.h"
#include "core/world/body.h"
#include "core/world/budget.h"
#include "planner/app/config_reader.h"
#include "planner/planner.h"
#include "planner/planning_world.h"
#include "runtime/config.h"
#include "runtime/scenario_file.h"
#include "semantic_mapper/app/load_map.h"
#include "semantic_mapper/app/mapper_config.h"
#include "simulator/app/world_broadcast.h"
#include "simulator/worlds/declared_motions.h"

namespace tern {
namespace {

constexpr UTime kStart{1'000'000};
constexpr Duration kPromised{5'000'000};
constexpr double kNear = 1.0;    // m
constexpr double kStep = 0.005;  ///< s, between samples of the measures

HorizonRequest request_of(const UavSpec& uav) {
  HorizonRequest request;
  request.header.utime = kStart;
  request.id = 1;
  request.t_s = kStart;
  request.deadline = kStart + Duration{100'000};
  request.start.p = uav.start;
  request.committed.start = kStart - Duration{10'000'000};
  request.committed.control_points = uav.start.replicate(1, request.committed.control_points.cols());
  request.limits = uav.limits;
  request.body = uav.body;
  request.flight_box = uav.flight_box;
  return request;
}

PlanningWorld world_of(const Scenario& scenario, TrackSet tracks, const VoxelMap& map, const PlannerConfig& config) {
  PlanningWorld world;
  world.predictions = std::make_shared<const PredictionProducts>(std::move(tracks));
  const auto products = std::make_shared<const MapProducts>(map, config);
  world.map = products;
  Goal goal;
  goal.id = 1;
  goal.position = scenario.uav.goal;
  const GoalFieldKey key{goal.position,           products->version,
                         digest_of({}),           body_box(scenario.uav.body),
                         scenario.uav.flight_box, way_speed(*products, scenario.uav.limits)};
  auto field = std::make_shared<const GoalField>(make_goal_field(key, products, {}, scenario.uav.start));
  world.goal = std::make_shared<const GoalProducts>(GoalProducts{goal, key, std::move(field), {}});
  return world;
}

std::vector<SearchSegment> segments_of(const TimedSpline& trajectory, const PredictionProducts& predictions,
                                       const Body& body) {
  const ClampedSpline spline = trajectory.spline();
  std::vector<double> times;
  for (int j = 0; j <= spline.intervals(); ++j) times.push_back(j * spline.interval_s());
  const Box everywhere(Vec3::Constant(-1e3), Vec3::Constant(1e3));
  const SweptObstacles swept(predictions.obstacles, body, trajectory.start, times, everywhere);
  SeparationCache cache(swept);
  std::vector<SearchSegment> segments;
  for (int j = 0; j < spline.intervals(); ++j) {
    SearchSegment segment;
    segment.curve_hull = spline.minvo(j);
    segment.obstacle_hull = cache.hull(swept.neighbours(j).at(0), {j});
    if (const auto apart = separate(segment.obstacle_hull, segment.curve_hull, body.radius)) {
      segment.plane = apart->plane;
      segment.gap_m = apart->gap;
    }
    segments.push_back(std::move(segment));
  }
  return segments;
}

void measure(SearchOutcome& outcome) {
  const ClampedSpline spline = outcome.trajectory.spline();
  const auto& regions = outcome.scenario.semantics.regions;
  Vec3 at = spline.sample(0.0).p;
  double weighed = 0.0;
  for (int k = 1; (k - 1) * kStep < spline.duration_s(); ++k) {
    const Vec3 next = spline.sample(k * kStep).p;
    const double step = (next - at).norm();
    outcome.path_length_m += step;
    at = next;
    if (regions.empty()) continue;
    const Region& region = regions.front();
    weighed += step * (at - region.bounds().center()).norm();
    if (region.distance(at) <= 0.0) outcome.inside_m += step;
    if (region.distance(at) <= kNear) outcome.near_m += step;
  }
  if (outcome.path_length_m > 0.0) outcome.mean_distance_m = weighed / outcome.path_length_m;
}

}  // namespace

const std::vector<SearchCase>& search_cases() {
  // From rest with J = 6 and four metres, the horizon must be long and far enough for a detour to end at the goal.
  static const std::vector<std::string> kHorizon = {"planner.duration_scales=[1.5]", "planner.sphere_radius_m=5",
                                                    "planner.semantic_path=false"};
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), kHorizon.begin(), kHorizon.end());
    return more;
  };
  static const std::vector<SearchCase> kCases = {
      {"none", "No semantics", "paper_search", with({"semantics.enabled=false"})},
      {"attractive", "Attractive region, λ_att = 2", "paper_search", with({"semantics.lambda_attractive=2"})},
      {"repulsive", "Repulsive region, λ_rep = 0.5", "paper_search_repel", with({"semantics.lambda_repulsive=0.5"})}};
  return kCases;
}

SearchOutcome run_search_case(const SearchCase& wanted, const std::vector<std::string>& more) {
  std::vector<std::string> overrides = wanted.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  ConfigDocument document = ConfigDocument::load(value_or_throw(find_scenario(wanted.scenario)), overrides);
  SearchOutcome outcome;
  outcome.scenario = read_scenario(document);
  const Scenario& scenario = outcome.scenario;
  PlannerConfig config = read_planner_config(document.root().section("planner"), scenario.semantics);
  config.optimization.method = OptimizationMethod::SearchOnly;
  const VoxelMap map = load_map(scenario, read_mapper_config(document.root().section("mapper")), nullptr).map;
  TrackSet tracks = declare_motions(world_of(scenario), kStart, kStart, kStart + kPromised);
  if (tracks.tracks.size() != 1) throw ConfigError(scenario.file + ": the experiment takes one obstacle");
  outcome.obstacle = tracks.tracks.front();
  const HorizonRequest request = request_of(scenario.uav);
  const PlanningWorld planning_world = world_of(scenario, std::move(tracks), map, config);
  Budget budget = Budget::unlimited();
  const PlanAnswer answer = plan(request, planning_world, config, budget);
  outcome.expansions = answer.statistics.expansions;
  outcome.found = answer.plan.outcome == PlanOutcome::SearchOnly;
  if (!outcome.found) return outcome;
  outcome.trajectory = answer.plan.trajectory;
  outcome.segments = segments_of(outcome.trajectory, *planning_world.predictions, scenario.uav.body);
  measure(outcome);
  return outcome;
}

std::string search_columns() {
  std::string columns = "case,found,duration_s,path_length_m,mean_distance_m,inside_m,near_m,expansions";
  for (int j = 1; j <= 6; ++j) columns += fmt::format(",gap_{}_m", j);
  return columns;
}

std::string to_csv(const SearchCase& which, const SearchOutcome& o) {
  std::string line = fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{}", which.name, o.found ? 1 : 0,
                                 o.found ? o.trajectory.spline().duration_s() : 0.0, o.path_length_m, o.mean_distance_m,
                                 o.inside_m, o.near_m, o.expansions);
  for (const SearchSegment& segment : o.segments) line += fmt::format(",{:.3f}", segment.gap_m);
  return line;
}

}  // namespace tern
