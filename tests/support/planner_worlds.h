// What planner tests are made of: movers, vehicles under way, whole worlds, and slow but obvious answers about them.
#pragma once

#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/world/horizon.h"
#include "core/world/track.h"
#include "planner/planning_world.h"

namespace tern::support {

/// The smooth mover: a Lissajous curve through `where`, up to 6 m/s, as Hermite pieces from `from` on. Its α differs
/// from piece to piece; half-extents are 0.1 … 0.6 m.
Track random_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds);
/// The nasty mover: arbitrary cubics that jump at their joints.
Track jumping_mover(Rng& rng, std::int64_t id, const Box& where, UTime from, double seconds);
/// A straight line through p at `from`; one piece, no α.
Track straight_mover(std::int64_t id, const Vec3& p, const Vec3& v, double half, UTime from, double seconds);
/// Never moves. One piece of 1 s, no α.
Track standing_box(std::int64_t id, const Box& box, UTime from);

/// A sphere of 0.1 m, a box of corners, or a lopsided polytope.
enum class BodyKind { Sphere, BoxShape, Polytope };
inline constexpr BodyKind kBodyKinds[] = {BodyKind::Sphere, BodyKind::BoxShape, BodyKind::Polytope};
Body body_of(BodyKind kind);

/// Obstacles as PredictionProducts makes them; the tracks must outlive them.
std::vector<PlanningObstacle> obstacles_of(const std::vector<Track>& tracks);

/// Oracle: the box that the track promises at t, with what counts of its α. Beyond its pieces it grows by top_speed.
Box promised_box(const Track& track, UTime t, const AlphaShare& count = {});
/// Oracle: the largest d·x over everything that the obstacle's box may cover in [from, to] seconds after origin. By the
/// extrema of the cubics d·p(t), so exact to rounding; β is not in it.
double support_of_sweep(const Track& track, const AlphaShare& count, UTime origin, double from, double to,
                        const Vec3& d);
/// Oracle: the distance between the body at p and the box; 0 when they meet.
double gap(const Body& body, const Vec3& p, const Box& box);
/// Oracle: the least gap between the body on its trajectory (at rest after its end) and the obstacles, at instants
/// `step` apart.
double least_gap(const TimedSpline& trajectory, const Body& body, const std::vector<PlanningObstacle>& obstacles,
                 UTime from, UTime to, Duration step = Duration{2'000});

/// Control points from `start` to rest within the limits, drawn at their edges as often as inside. (A v_1 that the
/// start drives beyond v_max is not held against it.)
/// @return nullopt if J intervals of dt do not suffice
std::optional<Points> random_way_to_rest(Rng& rng, const MotionSample& start, const Limits& limits, int intervals,
                                         double dt);
/// The same from rest at p, in time.
TimedSpline random_trajectory(Rng& rng, const Vec3& p, UTime start, const Limits& limits, int intervals = 8);
/// Rests at p from `start` on.
TimedSpline resting_at(const Vec3& p, UTime start);

/// Asks for a plan from t_s on; published 75 ms before, due 5 ms before.
HorizonRequest request_at(UTime t_s, const TimedSpline& committed);

/// A map of free voxels, and what a plan is made from.
PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config, const VoxelMap& map);
PlanningWorld world_of(std::vector<Track> tracks, const Goal& goal, const HorizonRequest& request,
                       const PlannerConfig& config = {});
Goal go_to(const Vec3& p);

}  // namespace tern::support
