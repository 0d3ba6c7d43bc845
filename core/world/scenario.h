// A scenario: the world, the vehicle, what its regions mean. Plain values; runtime/ reads them from YAML, strictly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/types.h"
#include "core/world/region.h"
#include "core/world/vehicle.h"

namespace tern {

/// Motions of BENCHMARKS; t is world time in seconds.
struct StaticMotion {};
/// c + (k_x (sin(w+φ) + 2 sin(2w+φ)), k_y (cos(w+φ) − 2 cos(2w+φ)), −k_z sin(3w+φ)), w = t/s.
struct TrefoilMotion {
  Vec3 scale = Vec3::Ones();  ///< k, m
  double slowness = 1.0;      ///< s, > 0
  double phase = 0.0;         ///< φ, rad
};
/// c + amplitude · sin(t/s + φ).
struct WaveMotion {
  Vec3 amplitude = Vec3::Zero();  ///< m
  double slowness = 1.0;          ///< s, > 0
  double phase = 0.0;             ///< φ, rad
};
/// c + velocity · (t − from_s) from from_s on; before it rests at c.
struct LinearMotion {
  Vec3 velocity = Vec3::Zero();  ///< m/s
  double from_s = 0.0;           ///< world time, s
};
/// Straight lines between timed points (c is not used); rests at the ends, or repeats, or exists between them only.
struct WaypointMotion {
  std::vector<std::pair<double, Vec3>> points;  ///< (world time s, position m), times strictly ascending, ≥ 1
  bool repeat = false;  ///< the last point is the first one; the motion goes round for ever, also before the first time
  bool vanish = false;  ///< absent before the first time and after the last (recorded people); not with repeat
  double leave_out_within_m = 0.0;  ///< with vanish: who appears in flight nearer to the vehicle is left out of it, m
};

struct ObstacleSpec {
  std::string name;                         ///< may be empty
  Vec3 centre = Vec3::Zero();               ///< c, W, m
  Vec3 half_extents = Vec3::Constant(0.4);  ///< m, > 0
  std::variant<StaticMotion, TrefoilMotion, WaveMotion, LinearMotion, WaypointMotion> motion;
};

/// Tracks of people or things from a text file of white-space separated numbers.
struct RecordedTracksSpec {
  std::string file;  ///< relative to the scenario's folder, or to TERN_DATA, or absolute
  int columns = 5;   ///< numbers per line
  int id_column = 0, frame_column = 1, x_column = 2, y_column = 3;  ///< id_column −1: the file is one track
  std::optional<int> z_column;                                      ///< none: z is not recorded
  double metres_per_unit = 1.0;
  double frames_per_second = 25.0;
  double least_step_s = 0.0;  ///< positions of a track that follow sooner than this are passed over
  /// World time 0 is this time of the file (frame / frames_per_second); nullopt: the seed draws it.
  std::optional<double> start_s;
  Vec3 half_extents = Vec3(0.25, 0.25, 1.0);  ///< of every person, m
  double centre_z = 1.0;                      ///< boxes stand here, m
  bool wait_for_clear_start =
      true;  ///< start at the first frame ≥ start_s when none comes within 1 m of the start for 1 s
  double leave_out_within_m = 3.0;  ///< of WaypointMotion: there the recording begins, not the person
  int copies = 0;  ///< > 0: so many movers on pieces of the tracks, drawn by the seed, in place of them
  Box within;      ///< where the copies are, W; with copies only
};

struct WorldSpec {
  std::string generator =
      "none";     ///< none, paper_corridor, paper_attract, paper_repel, corridor_demo, mader_corridor, sando_forest
  int count = 0;  ///< N of the generator, 0 … 100000
  std::optional<double> slowness;            ///< of the generator's trefoils instead of its own, > 0
  std::vector<ObstacleSpec> obstacles;       ///< besides the generator's
  std::vector<RecordedTracksSpec> recorded;  ///< besides these
};

struct SemanticsSpec {
  bool enabled = true;
  std::vector<Region> regions;
  double lambda_attractive = 2.0;                       ///< λ_att ≥ 0
  double lambda_repulsive = 2.0;                        ///< λ_rep ≥ 0
  std::vector<std::pair<std::string, double>> lambdas;  ///< classes with a λ of their own, ≥ 0; not named: the label's
  std::string cost = "exposure";                        ///< exposure, mean_distance
  /// class → label name (unknown, free, occupied, attractive, repulsive)
  std::vector<std::pair<std::string, std::string>> classes = {{"texture", "attractive"}, {"water", "repulsive"}};
};

struct UavSpec {
  Vec3 start = Vec3(0.0, 0.0, 1.0);  ///< at rest, W, m
  Vec3 goal = Vec3(75.0, -1.0, 1.0);
  Limits limits;
  Body body;
  Box flight_box{Vec3::Constant(-1e4), Vec3::Constant(1e4)};  ///< the body stays inside
};

struct Scenario {
  std::string name;
  std::string file;  ///< where it was read
  std::uint64_t seed = 1;
  WorldSpec world;
  UavSpec uav;
  SemanticsSpec semantics;
  std::optional<double> timeout_s;  ///< flight_timeout_s() has the default
};

/// When a flight has taken too long, world time, s: timeout_s, or 3 × bound + 10 s.
double flight_timeout_s(const Scenario& scenario);

/// Time to reach speed v from rest, and how far that takes, under acceleration a and jerk j (may be infinite).
struct RampUp {
  double time, distance;  ///< s, m
};
RampUp ramp_up(double v, double a, double j);

/// The time-optimal time of one axis from rest to rest over `distance` ≥ 0, s; j may be infinite.
double rest_to_rest_s(double distance, double v_max, double a, double j);

/// BENCHMARKS' bound: the per-axis time-optimal rest-to-rest time from start to goal, jerk included where it is
/// limited, s.
double rest_to_rest_bound_s(const Vec3& from, const Vec3& to, const Limits& limits);

}  // namespace tern
