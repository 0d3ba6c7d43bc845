// The planner's tuning numbers: chosen by experiment, neither derived nor knobs. Tolerances stand where they are
// defined.
#pragma once

#include <cstdint>

#include "core/base/time.h"

namespace tern {

// ---- Durations (duration.h, attempt.h)

/// Below this Δt rounding of accelerations q/Δt² would exceed the tolerances, s.
inline constexpr double kMinInterval = 0.02;
/// A spline of J intervals from rest to rest takes this much longer than the per-axis bound of min_duration().
inline constexpr double kStopScale = 1.5;
/// Jerk is gentle where less than this share of a_max is reached on the way …
inline constexpr double kGentleShare = 0.1;
/// … which counts as no shorter than this, m.
inline constexpr double kMinPacedLength = 1e-4;

// ---- How far ahead (look_ahead.h, hold.h, planning_world.h)

/// The horizon is at least this long where movers are followed so far, s.
inline constexpr double kMinHorizon = 3.0;
/// How far past its last piece a track's box is followed where the vehicle may meet it. By then the box of what is
/// faster than a metre per second fills the sphere; who needs longer takes smaller steps (LookAhead).
inline constexpr Duration kTrackBoxReach{4'000'000};
/// Holds are followed in such steps, s, where Δt is shorter: so that a hold costs few hulls.
inline constexpr double kHoldStep = 0.1;
/// The horizon does not cut holds below this, s.
inline constexpr double kMinHold = 0.1;

// ---- The local goal and the way to it (heading.h, look_ahead.h, planner.cpp)

/// The sphere's border is left to rounding and to MINVO points that bulge: local goals lie this far inside, as a share
/// of r.
inline constexpr double kLocalGoalShare = 0.985;
/// From one radius of the local goal to the next smaller one.
inline constexpr double kRadiusShrink = 5.0 / 6.0;
/// No local goal is nearer, m: what the gentlest vehicle flies from rest to rest in kMinHorizon is longer.
inline constexpr double kMinRadius = 1e-4;
/// Static obstacles are grown by this for paths, m: flights by hulls need a little room.
inline constexpr double kPathSpacing = 0.02;
/// A path that is longer than the straight line, or cheaper, by no more than this counts as straight, m.
inline constexpr double kBendIgnored = 0.15;
/// At rest on the way to a goal and without a plan: how many smaller steps are tried, and by what they shrink.
inline constexpr int kSmallerSteps = 3;
inline constexpr double kSmallerStep = 3.0;
/// A plan from there that leads no further than this share of the way to the local goal is none.
inline constexpr double kMinProgress = 0.01;

// ---- The search's lengths for near local goals (look_ahead.h)

/// Local goals at least this far away, m, and flights there of at most so many seconds are what the search's lengths
/// were chosen for.
inline constexpr double kFullStep = 2.0;
inline constexpr double kFullStepTime = 4.0;
/// Of a step's mean speed: velocities that differ by less are one to its pruning.
inline constexpr double kCoarseVelocityShare = 0.4;

// ---- The search (semantic_a_star.h, step_reach.h)

/// A share of r that is surely within S, with what the curve bulges.
inline constexpr double kSphereShare = 0.97;
/// The last band of the cost-to-go is so many times finer than the others, so that the goal itself is reached.
inline constexpr std::int64_t kFinerBands = 10;
/// Shares of the way back to the steady range at which a step's thrust is tried, where it is too much without.
inline constexpr double kReturnShares[] = {0.25, 0.5, 0.75, 1.0};

// ---- Paths around static obstacles (goal_field.h)

/// How often a path is tightened as a whole, and how often the pull at one vertex is halved.
inline constexpr int kTightenPasses = 3;
inline constexpr int kPullHalvings = 6;

// ---- What a trajectory is worth (heading.h, refinement.h, standing_answer.h, planner.cpp)

/// For how long a trajectory is taken to be flown before a better one follows, s. Where a step takes minutes, it is
/// this share of the step: nothing better follows within a second.
struct FlownTime {
  double min_s;
  double share;
};
inline constexpr FlownTime kFlownTimes[] = {{0.3, 0.15}, {0.8, 0.4}};
/// Chords of this much time stand for the curve in semantic costs: they leave it by a_max·kChord²/8, centimetres, s.
inline constexpr double kChord = 0.1;
/// An optimized trajectory may arrive so much later than the search's, and one that sets out than waiting, s.
inline constexpr double kMaxArrivalLoss = 0.05;
/// Where Δt is shorter than this arrivals say little, and one step may cross the sphere …
inline constexpr Duration kShortInterval{40'000};
/// … and an optimized trajectory keeps this share of the leaf's progress at least.
inline constexpr double kMinProgressKept = 0.5;
/// A plan that sets out ends nearer to the local goal by this, m.
inline constexpr double kMinApproach = 1e-6;
/// No longer duration is tried once an end that holds lies this near the local goal, m.
inline constexpr double kAtLocalGoal = 1.0;

// ---- Less sure (assurance.h, less_sure.h)

/// How long α grows, in times that the vehicle needs to step aside: at the promised level …
inline constexpr double kGrowthTimes[] = {2.0, 1.0};
/// … then once that time at these levels.
inline constexpr int kReducedLevels[] = {2, 4};
/// Parts of the last level's α, growing for that time, that are counted where even that leaves nothing.
inline constexpr double kAlphaScales[] = {0.8, 0.6, 0.45, 0.35, 0.25};
/// Nodes expanded per duration there, at most, in all and after the first leaf: several such searches share the time.
inline constexpr int kReducedExpansions = 300;
inline constexpr int kReducedHoldExpansions = 100;
/// Less of α is counted until something leads at least this share of the way to the local goal.
inline constexpr double kMinSettledProgress = 0.25;
/// Who rests short of the goal sets out at a confidence after this times what is missing to 1, if it may stay, s.
inline constexpr double kMaxWaitAtRest = 1.0;

// ---- A multirotor's thrust (safety/thrust_set.h, search/step_reach.h, optimization/convex_problem.h)

/// Plans lower the thrust's vertical part by at most this share of g; half of it where rest must remain reachable.
inline constexpr double kThrustDip = 0.5;
/// In Eq. 4 that part keeps this share of what the search's result has at each knot, so that jerk may be bounded by it.
inline constexpr double kMinThrustKept = 0.8;

// ---- The budget by the clock (app/planner_node.h)

/// Shares of the time from arrival to the watchdog: after these, no new duration is tried, the search ends, the
/// optimizer and evasion end.
inline constexpr double kAttemptShare = 0.3;
inline constexpr double kSearchShare = 0.42;
inline constexpr double kOptimizationShare = 0.85;

// ---- Evasion (evasion.h)

/// Stops that are searched for at most, and nodes expanded for each.
inline constexpr int kMaxStops = 40;
inline constexpr int kStopExpansions = 150;
/// Durations over min_duration(): at leisure, and as quick as a far stop can be flown. To hurry far away pays where
/// motion is promised; among estimated movers, whose boxes grow, it leads into what is not yet known.
inline constexpr double kStopPaces[] = {kStopScale, 1.15};
/// Stops lie this far away, in what vehicle and largest mover are wide together, but within a share of r …
inline constexpr double kStopWidths[] = {0.3, 0.6, 1.1, 2.0};
inline constexpr double kMaxWidthShare = 0.9;
/// … or, to get far away, in r.
inline constexpr double kStopShares[] = {0.35, 0.8};
/// The forecast's steps, and how far it reaches at most, s.
inline constexpr double kForecastStep = 0.05;
inline constexpr double kMaxForecast = 20.0;

// ---- A start inside a hull (start_clearance.h)

/// An α that is scaled leaves this much room at the start, m: more than touching, because the first interval's hull
/// moves on.
inline constexpr double kStartSlack = 1e-3;

// ---- Eq. 4 (convex_problem.h, barrier_solver.h)

/// Limits farther away than this share of themselves are left out: an axis that x0 leaves at rest may go to half its
/// limit.
inline constexpr double kLimitReach = 1.5;
/// Jerk is bounded by this times x0's own at least, so that x0 lies strictly inside.
inline constexpr double kJerkRoom = 1.001;
/// The barrier method's first slacks are no less, m.
inline constexpr double kMinFirstSlack = 0.1;
/// How much of the way to the nearest bound a step goes, and the step below which it has failed.
inline constexpr double kStepShare = 0.995;
inline constexpr double kMinStep = 1e-8;
/// The first barrier, of what there is to gain, and the last, of the tolerance: shared among the constraints.
inline constexpr double kFirstBarrierShare = 0.1;
inline constexpr double kLastBarrierShare = 0.3;

}  // namespace tern
