// Growth of cost with obstacles in the world, obstacles in reach, voxels, and the number of intervals J.
// Writes CSV: table, size, quantity, value. Times are thread CPU time; memory is the peak of a child process.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "core/base/random.h"
#include "core/world/track_order.h"
#include "messages/batching.h"
#include "planner/plan_workspace.h"
#include "predictor/models/declared.h"
#include "runtime/command_line.h"
#include "runtime/stopwatch.h"

namespace tern {
namespace {

constexpr UTime kNow{100'000'000};
constexpr double kHorizonS = 3.5;

void print(const char* table, std::int64_t size, const std::string& quantity, double value) {
  fmt::print("{},{},{},{:.6g}\n", table, size, quantity, value);
  std::fflush(stdout);
}

double median_ms(int runs, const std::function<void()>& work) {
  std::vector<double> ms;
  for (int k = 0; k < runs; ++k) ms.push_back(cpu_ms_of(work));
  std::nth_element(ms.begin(), ms.begin() + runs / 2, ms.end());
  return ms[static_cast<std::size_t>(runs / 2)];
}

/// An obstacle that swings about its place, in pieces as DECLARED_MOTIONS has them.
Track swinging(std::int64_t id, const Vec3& centre, double half, double amplitude, Rng& rng) {
  Track track;
  track.id = id;
  track.half_extents = Vec3::Constant(half);
  const double phase = rng.uniform(0.0, 6.28);
  const double rate = rng.uniform(0.5, 1.0);
  track.motion = hermite_fit(kNow, Duration{430'000}, 9, [&](Duration t) {
    MotionSample s;
    const double w = rate * t.seconds() + phase;
    s.p = centre + amplitude * Vec3(std::sin(w), std::cos(w), std::sin(2.0 * w));
    s.v = amplitude * rate * Vec3(std::cos(w), -std::sin(w), 2.0 * std::cos(2.0 * w));
    return s;
  });
  track.alpha.assign(track.motion.pieces.size(), Vec3::Constant(0.005));
  track.top_speed = 2.0 * amplitude;
  return track;
}

/// … and the planner's settings.
struct Setting : Moment {
  PlannerConfig config;
};

/// A request from rest at the origin to a goal 30 m ahead, with these tracks only.
Setting setting(std::vector<Track> tracks) {
  Setting s;
  s.request.header.utime = kNow;
  s.request.header.name = {1, 1};
  s.request.id = 1;
  s.request.t_s = kNow + Duration{75'000};
  s.request.deadline = kNow + Duration{70'000};
  s.request.committed.start = s.request.t_s;
  s.request.committed.control_points = Points::Zero(3, 9);
  s.request.flight_box = Box(Vec3(-1e4, -1e4, -3), Vec3(1e4, 1e4, 3));
  TrackSet set;
  set.made_at = kNow;
  set.tracks = std::move(tracks);
  s.world.predictions = std::make_shared<const PredictionProducts>(std::move(set));
  VoxelMap map;
  map.class_names = {""};
  s.world.map = std::make_shared<const MapProducts>(map, s.config);
  GoalProducts goal;
  goal.goal.position = Vec3(30, 0, 0);
  goal.key.goal = goal.goal.position;
  goal.key.flight_box = Box(Vec3(-10, -10, -3), Vec3(40, 10, 3));
  goal.field = std::make_shared<const GoalField>(make_goal_field(goal.key, s.world.map, {}, Vec3::Zero()));
  s.world.goal = std::make_shared<const GoalProducts>(goal);
  return s;
}

double plan_ms(const Setting& s, int runs) {
  PlanWorkspace workspace;
  return median_ms(runs, [&] {
    Budget budget = Budget::unlimited();
    plan(s.request, s.world, s.config, budget, workspace);
  });
}

/// 20 moving obstacles near, the others at one per 25 m² on a square beyond 40 m. Only the near ones matter.
std::vector<Track> world_of(std::int64_t obstacles) {
  Rng rng(1);
  std::vector<Track> tracks;
  const double side = 80.0 + 5.0 * std::sqrt(static_cast<double>(obstacles));
  for (std::int64_t id = 1; id <= obstacles; ++id) {
    Vec3 centre(rng.uniform(1.5, 8.0), rng.uniform(-4.0, 4.0), rng.uniform(-2.0, 2.0));
    if (id > 20) {
      do centre = Vec3(rng.uniform(-side, side), rng.uniform(-side, side), 0.0);
      while (centre.norm() < 40.0);
    }
    tracks.push_back(swinging(id, centre, 0.3, 0.4, rng));
  }
  return tracks;
}

void obstacles_in_the_world(std::int64_t most) {
  for (std::int64_t n = 10; n <= most; n *= 10) {
    const std::vector<Track> tracks = world_of(n);
    const int runs = n > 5'000 ? 5 : 51;
    print("world", n, "plan_ms", plan_ms(setting(tracks), 51));
    print("world", n, "intake_ms", median_ms(runs, [&] {
            TrackSet set;
            set.tracks = tracks;
            const PredictionProducts products(std::move(set));
          }));
    print("world", n, "predict_ms", median_ms(runs, [&] {
            const Duration horizon = Duration::from_seconds(kHorizonS);
            TrackSet set;
            set.tracks = merged(trimmed(tracks, kNow, horizon), {}, kNow);
            sort_by_reach(set.tracks, Vec3::Zero(), kNow, horizon);
            split_batches(set);
          }));
  }
}

/// Small moving obstacles, all within a metre of the sphere.
void obstacles_in_reach() {
  for (const int n : {10, 20, 50, 100, 200, 300}) {
    Rng rng(2);
    std::vector<Track> tracks;
    while (static_cast<int>(tracks.size()) < n) {
      const Vec3 centre(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(-3.0, 3.0));
      if (centre.norm() < 1.0 || centre.norm() > 5.0) continue;
      tracks.push_back(swinging(static_cast<std::int64_t>(tracks.size()) + 1, centre, 0.1, 0.2, rng));
    }
    const Setting s = setting(tracks);
    Budget budget = Budget::unlimited();
    PlanWorkspace workspace;
    const PlanAnswer answer = plan(s.request, s.world, s.config, budget, workspace);
    print("reach", n, "plan_ms", plan_ms(s, 21));
    print("reach", n, "expansions", static_cast<double>(answer.statistics.expansions));
    print("reach", n, "hulls", static_cast<double>(answer.statistics.hulls));
  }
}

/// Runs a case in a child process, so the peak memory is its own.
void in_a_child(const std::function<void()>& work) {
  std::fflush(stdout);  ///< the child would print unflushed text as well
  const pid_t child = fork();
  if (child == 0) {
    work();
    std::fflush(stdout);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

/// A town of blocks at 0.25 m; a tenth of its voxels are attractive or repulsive facades.
VoxelMap town(std::int64_t voxels) {
  VoxelMap map;
  const int height = 40;
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(voxels) / height)));
  map.grid.size = {side, side, height};
  map.grid.origin = Vec3(-0.125 * side, -0.125 * side, 0.0);
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Free);
  map.classes.assign(map.labels.size(), 0);
  map.class_names = {"", "texture", "water"};
  for (int z = 0; z < height; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int bx = x % 80;
        const int by = y % 80;
        if (bx < 20 || by < 20 || z >= 30) continue;
        const auto at = static_cast<std::size_t>(map.grid.index({x, y, z}));
        map.labels[at] = VoxelLabel::Occupied;
        if (bx == 20) map.labels[at] = (y / 80) % 2 == 0 ? VoxelLabel::Attractive : VoxelLabel::Repulsive;
      }
    }
  }
  return map;
}

void voxels(std::int64_t most) {
  for (std::int64_t n = 10'000; n <= most; n *= 10) {
    in_a_child([n] {
      const VoxelMap map = town(n);
      const double before_kb = static_cast<double>(peak_rss_kb());
      double begin = thread_cpu_ms();
      const MapProducts products(map, PlannerConfig{});
      print("voxels", n, "fields_s", 1e-3 * (thread_cpu_ms() - begin));
      print("voxels", n, "map_mb", 2e-6 * static_cast<double>(map.grid.voxels()));
      print("voxels", n, "fields_peak_mb", 1e-3 * (static_cast<double>(peak_rss_kb()) - before_kb));
      print("voxels", n, "boxes", static_cast<double>(products.occupied.boxes().size()));
      begin = thread_cpu_ms();
      const auto chunks = to_chunks(map);
      print("voxels", n, "chunks", static_cast<double>(chunks.size()));
      print("voxels", n, "cut_s", 1e-3 * (thread_cpu_ms() - begin));
    });
  }
}

void intervals(const std::string& scenario) {
  for (int j = 4; j <= 12; ++j) {
    const FlightRecording flight =
        record_flight(scenario, {"seed=1", "world.count=100", fmt::format("planner.intervals={}", j)});
    PlanWorkspace workspace;
    std::vector<double> ms;
    for (const Moment& m : flight.moments) ms.push_back(plan_ms(m, flight.config, workspace));
    std::sort(ms.begin(), ms.end());
    print("intervals", j, "plan_p50_ms", ms[ms.size() / 2]);
    print("intervals", j, "plan_p99_ms", ms[ms.size() * 99 / 100]);
    print("intervals", j, "flight_s", flight.result.flight_time_s);
  }
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app{"How the planner's cost grows, as CSV: table, size, quantity, value."};
  std::string scenario;
  std::int64_t most_voxels = 100'000'000;
  std::int64_t most_obstacles = 100'000;
  app.add_option("--config", scenario, "Scenario whose flight is repeated with J = 4 ... 12")->required();
  app.add_option("--most-voxels", most_voxels, "Up to this many voxels");
  app.add_option("--most-obstacles", most_obstacles, "Up to this many obstacles in the world");
  if (const auto code = app.parse(argc, argv, 2)) return *code;
  fmt::print("table,size,quantity,value\n");
  tern::voxels(most_voxels);  ///< first, since a child's peak starts at this process's memory
  tern::obstacles_in_the_world(most_obstacles);
  tern::obstacles_in_reach();
  tern::intervals(scenario);
  return 0;
}
