#include "simulator/worlds/world.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/digest.h"
#include "core/base/random.h"
#include "simulator/worlds/drawn_recordings.h"
#include "simulator/worlds/generators.h"
#include "simulator/worlds/recorded_tracks.h"

namespace tern {
namespace {

Result<void> add(World& world, std::vector<ObstacleSpec> specs) {
  for (ObstacleSpec& spec : specs) {
    auto made = WorldObstacle::make(static_cast<std::int64_t>(world.obstacles.size()), std::move(spec));
    if (!made) return tl::unexpected(made.error());
    world.obstacles.push_back(std::move(*made));
  }
  return {};
}

/// The obstacles of one recording. Records in `world` how they were chosen.
Result<std::vector<ObstacleSpec>> recorded_specs(World& world, const Scenario& scenario,
                                                 const RecordedTracksSpec& recorded, Rng& rng,
                                                 const std::string& data_dir) {
  const auto file = find_track_file(recorded.file, scenario.file, data_dir);
  if (!file) return tl::unexpected(file.error());
  auto read = load_recorded_tracks(*file, recorded);
  if (!read) return tl::unexpected(read.error());
  world.remarks.insert(world.remarks.end(), read->remarks.begin(), read->remarks.end());
  std::vector<RecordedTrack>& tracks = read->tracks;
  if (recorded.copies > 0) {
    auto copies = scatter_copies(rng, tracks, recorded, scenario.uav.start, flight_timeout_s(scenario));
    if (!copies) return tl::unexpected(copies.error());
    world.redrawn += copies->redrawn;
    return std::move(copies->obstacles);
  }
  const auto start = recorded.start_s ? recorded_start(tracks, recorded, scenario.uav.start)
                                      : draw_start(rng, tracks, recorded, scenario.uav);
  if (!start) return tl::unexpected(start.error());
  world.recorded_start_s.push_back(*start);
  if (!recorded.start_s) {
    world.left_out += static_cast<int>(std::erase_if(
        tracks, [&](const RecordedTrack& track) { return crowds_start(track, *start, scenario.uav.start); }));
  }
  return recorded_obstacles(tracks, recorded, *start);
}

}  // namespace

Result<World> make_world(const Scenario& scenario, const std::string& data_dir) {
  World world;
  const WorldSpec& spec = scenario.world;
  if (spec.generator != "none") {
    auto made =
        generate(spec.generator, spec.count, scenario.seed, scenario.uav.start, scenario.uav.goal, spec.slowness);
    if (!made) return tl::unexpected(made.error());
    world.redrawn = made->redrawn;
    if (auto done = add(world, std::move(made->obstacles)); !done) return tl::unexpected(done.error());
  }
  if (auto done = add(world, spec.obstacles); !done) return tl::unexpected(done.error());
  for (std::size_t k = 0; k < spec.recorded.size(); ++k) {
    Rng rng(digest(fmt::format("world.recorded[{}]", k), scenario.seed));
    auto specs = recorded_specs(world, scenario, spec.recorded[k], rng, data_dir);
    if (!specs) return tl::unexpected(specs.error());
    if (auto done = add(world, std::move(*specs)); !done) return tl::unexpected(done.error());
  }
  return world;
}

Scenario list_obstacles(const Scenario& scenario, const World& world) {
  Scenario listed = scenario;
  listed.world = WorldSpec{};
  for (const WorldObstacle& o : world.obstacles) listed.world.obstacles.push_back(o.spec());
  return listed;
}

std::vector<TrueObstacle> true_obstacles(const World& world, double t_s) {
  std::vector<TrueObstacle> present;
  present.reserve(world.obstacles.size());
  for (const WorldObstacle& o : world.obstacles) {
    const double begins_s = o.begins_s();
    if (!o.present(t_s) || (t_s < begins_s && begins_s <= 0.0)) continue;
    const ObstacleState state = motion_state(o.spec(), t_s);
    present.push_back({o.id(), state.p, state.v, o.half_extents(), o.moves()});
  }
  return present;
}

std::vector<Box> static_boxes(const World& world) {
  std::vector<Box> boxes;
  for (const WorldObstacle& o : world.obstacles) {
    if (!o.moves()) boxes.push_back(o.box(0.0));
  }
  return boxes;
}

}  // namespace tern
