// A scenario as plain values: the world, the vehicle, and the meaning of its regions. runtime/ reads it from YAML.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/geodetic_point.h"
#include "core/base/types.h"
#include "core/scenario/region.h"
#include "core/world/fence.h"
#include "core/world/heading.h"
#include "core/world/vehicle.h"

namespace tern {

/// An obstacle at rest at its centre c. In the motions below, t is the world's time in seconds.
struct StaticMotion {};
/// A trefoil knot: c + (k_x (sin(w+φ) + 2 sin(2w+φ)), k_y (cos(w+φ) − 2 cos(2w+φ)), −k_z sin(3w+φ)), w = t/s.
struct TrefoilMotion {
  Vec3 scale = Vec3::Ones();  ///< k, m
  double slowness = 1.0;      ///< s, > 0
  double phase = 0.0;         ///< φ, rad
};
/// A wave: c + amplitude · sin(t/s + φ).
struct WaveMotion {
  Vec3 amplitude = Vec3::Zero();  ///< m
  double slowness = 1.0;          ///< s, > 0
  double phase = 0.0;             ///< φ, rad
};
/// The obstacle rests at c until from_s; then it is at c + velocity · (t − from_s).
struct LinearMotion {
  Vec3 velocity = Vec3::Zero();  ///< m/s
  double from_s = 0.0;           ///< world's time, s
};
/// The obstacle moves on straight lines between timed points; c is not used. Before the first and after the last time
/// the obstacle rests at the end point, or it repeats its motion, or it does not exist.
struct WaypointMotion {
  std::vector<std::pair<double, Vec3>> points;  ///< (world's time s, position m), ≥ 1, times strictly ascending
  bool repeat = false;  ///< the motion repeats at all times; its last point equals the first one
  bool vanish = false;  ///< it exists between the first and the last time only (recorded people); not with repeat.
  /// With vanish: the obstacle is left out of the flight if it appears within this distance of the vehicle, m.
  double leave_out_within_m = 0.0;
};

/// One obstacle: a box that moves.
struct ObstacleSpec {
  std::string name;                         ///< may be empty
  Vec3 centre = Vec3::Zero();               ///< c, W, m
  Vec3 half_extents = Vec3::Constant(0.4);  ///< m, > 0
  std::variant<StaticMotion, TrefoilMotion, WaveMotion, LinearMotion, WaypointMotion> motion;
};

/// Recorded tracks of people or things, from a text file of numbers separated by white space.
struct RecordedTracksSpec {
  std::string file;  ///< absolute, or relative to the scenario's folder or to TERN_DATA
  int columns = 5;   ///< numbers per line
  int id_column = 0, frame_column = 1, x_column = 2, y_column = 3;  ///< id_column −1: all lines are one track
  std::optional<int> z_column;                                      ///< nullopt: z is not recorded
  double metres_per_unit = 1.0;
  double frames_per_second = 25.0;
  double least_step_s = 0.0;  ///< the smallest time between two positions of a track; positions in between are skipped.
  /// The time in the file (frame / frames_per_second) that is the world's time 0; nullopt: the seed draws it.
  std::optional<double> start_s;
  Vec3 half_extents = Vec3(0.25, 0.25, 1.0);  ///< of every box, m
  double centre_z = 1.0;                      ///< z of every centre if it is not recorded, m.
  /// The file's time 0 is moved to the first frame ≥ start_s after which nobody comes within 1 m of the start for 1 s.
  bool wait_for_clear_start = true;
  /// A track that begins within this distance of the vehicle is left out of the flight, because the person would appear
  /// out of nothing. m
  double leave_out_within_m = 3.0;
  int copies = 0;  ///< > 0: this many obstacles on pieces of the tracks, drawn by the seed, instead of the tracks
  Box within;      ///< the region of the copies, W; with copies only
};

/// The obstacles of a world: generated, listed and recorded ones together.
struct WorldSpec {
  /// none, paper_corridor, paper_attract, paper_repel, corridor_demo, mader_corridor, sando_forest
  std::string generator = "none";
  int count = 0;                             ///< number N of generated obstacles, 0 … 100000
  std::optional<double> slowness;            ///< of the generated trefoils, > 0; nullopt: the generator's own
  std::vector<ObstacleSpec> obstacles;       ///< listed obstacles
  std::vector<RecordedTracksSpec> recorded;  ///< recorded obstacles
  std::optional<GeodeticPoint> origin;       ///< of W; nullopt: unknown, and places on the earth are refused
  std::vector<Fence> fences;                 ///< listed fences
  std::vector<FenceFile> fence_files;        ///< fences from files, in addition
};

/// The regions and their weights in the planner's cost.
struct SemanticsSpec {
  bool enabled = true;
  std::vector<Region> regions;
  double lambda_attractive = 2.0;                       ///< λ_att ≥ 0
  double lambda_repulsive = 2.0;                        ///< λ_rep ≥ 0
  std::vector<std::pair<std::string, double>> lambdas;  ///< λ ≥ 0 of single classes; all others have their label's λ
  std::string cost = "exposure";                        ///< exposure, mean_distance
  /// Class name → label name (unknown, free, occupied, attractive, repulsive).
  std::vector<std::pair<std::string, std::string>> classes = {{"texture", "attractive"}, {"water", "repulsive"}};
};

/// The vehicle and its task.
struct UavSpec {
  Vec3 start = Vec3(0.0, 0.0, 1.0);   ///< W, m; the vehicle is at rest there
  Vec3 goal = Vec3(75.0, -1.0, 1.0);  ///< W, m
  Limits limits;
  Body body;
  HeadingLimits heading;                                           ///< of planned headings
  Box flight_box = box_around(Vec3::Zero(), Vec3::Constant(1e4));  ///< the body stays inside, W, m
};

/// A scenario, without the sections of the processes.
struct Scenario {
  std::string name;
  std::string file;  ///< path of the scenario's file
  std::uint64_t seed = 1;
  WorldSpec world;
  UavSpec uav;
  SemanticsSpec semantics;
  std::optional<double> timeout_s;  ///< flight_timeout_s() has the default
};

/// Returns the world's time at which a flight ends with Timeout, s: timeout_s, or 3 × rest_to_rest_bound_s() + 10 s.
double flight_timeout_s(const Scenario& scenario);

/// Time and distance of an acceleration from rest.
struct RampUp {
  double time, distance;  ///< s, m
};
/// Returns how one axis reaches speed v from rest fastest, under acceleration a and jerk j; j may be infinite.
RampUp ramp_up(double v, double a, double j);

/// Returns the shortest time of one axis from rest to rest over `distance` ≥ 0, s; j may be infinite. The peak speed
/// is found by bisection if v_max is not reached.
double rest_to_rest_s(double distance, double v_max, double a, double j);

/// Returns a lower bound of the flight time from rest to rest, s: the largest rest_to_rest_s() of the three axes.
double rest_to_rest_bound_s(const Vec3& from, const Vec3& to, const Limits& limits);

}  // namespace tern
