// Parts of planner tests: moving obstacles, vehicles in flight, whole worlds, and slow but obvious oracles.
#pragma once

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/world/horizon.h"
#include "core/world/track.h"
#include "planner/planning_world.h"

namespace tern::support {

/// Returns a smooth obstacle: a Lissajous curve through `where`, up to 6 m/s, as Hermite pieces from `from` on. Its α
/// differs from piece to piece; its half-extents are 0.1 … 0.6 m.
Track random_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds);
/// Returns a rough obstacle: arbitrary cubics that jump at their joints.
Track jumping_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds);
/// Returns a straight line through p at `from`, with one piece and without α.
Track straight_mover(std::int64_t id, const Vec3& p, const Vec3& v, double half, UTime from, double seconds);
/// Returns an obstacle at rest, with one piece of 1 s and without α.
Track standing_box(std::int64_t id, const Box& box, UTime from);

/// Returns a sphere of 0.1 m, a box, or an asymmetric polytope.
enum class BodyKind { Sphere, BoxShape, Polytope };
inline constexpr BodyKind kBodyKinds[] = {BodyKind::Sphere, BodyKind::BoxShape, BodyKind::Polytope};
Body body_of(BodyKind kind);

/// Returns obstacles as PredictionProducts makes them; the tracks must outlive them.
std::vector<PlanningObstacle> obstacles_of(const std::vector<Track>& tracks);

/// Oracle: the box of the track at t, with a share of α. Outside its pieces it grows at top_speed.
Box promised_box(const Track& track, UTime t, const AlphaShare& count = {});
/// Oracle: the largest d·x over the region that the obstacle's box covers during [from, to] seconds after origin. It
/// follows from the extrema of the cubics d·p(t), so it is exact up to rounding; β is not included.
double support_of_sweep(const Track& track, const AlphaShare& count, UTime origin, double from, double to,
                        const Vec3& d);
/// Oracle: the distance between the body at p and the box; 0 if they touch or overlap.
double gap(const Body& body, const Vec3& p, const Box& box);
/// Oracle: the smallest gap between the obstacles and the body on its trajectory (at rest after its end), at times
/// `step` apart.
double least_gap(const TimedSpline& trajectory, const Body& body, const std::vector<PlanningObstacle>& obstacles,
                 UTime from, UTime to, Duration step = Duration{2'000});

/// Returns control points from `start` to rest within the limits, half of them at the edges of the limits. (v_1 may
/// exceed v_max, if the start requires it.)
/// @return nullopt if J intervals of dt do not suffice
std::optional<Points> random_way_to_rest(Rng& rng, const MotionSample& start, const Limits& limits, int intervals,
                                         double dt);
/// Returns such a trajectory from rest at p.
TimedSpline random_trajectory(Rng& rng, const Vec3& p, UTime start, const Limits& limits, int intervals = 8);
/// Returns the trajectory that rests at p from `start` on.
TimedSpline resting_at(const Vec3& p, UTime start);

/// Returns a request for a plan from t_s on, published 75 ms and due 5 ms before it.
HorizonRequest request_at(UTime t_s, const TimedSpline& committed);

/// Returns the inputs of a plan; without `map`, all voxels are free.
PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config, const VoxelMap& map);
PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config = {});
Goal go_to(const Vec3& p);

}  // namespace tern::support
