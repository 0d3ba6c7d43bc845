// The planner's tuning numbers: chosen by experiment. Keys of the scenario are in planner_config.h; tolerances stand
// where they are defined.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/time.h"

namespace tern {

// ---- Durations (duration.h, attempt.h)

/// The least Δt, s. Below it, rounding of accelerations q/Δt² would exceed the tolerances.
inline constexpr double kMinInterval = 0.02;
/// Duration of a spline of J intervals from rest to rest, as a multiple of min_duration().
inline constexpr double kStopScale = 1.5;
/// Jerk is gentle if less than this share of a_max is reached on the way.
inline constexpr double kGentleShare = 0.1;
/// The way in paced() is at least this long, m.
inline constexpr double kMinPacedLength = 1e-4;

// ---- How far ahead (look_ahead.h, hold.h, planning_world.h)

/// The horizon is at least this long, s, unless movers are followed for less.
inline constexpr double kMinHorizon = 3.0;
/// The growing box of a track near the vehicle is followed for this time after the track's last piece. By then the box
/// of a mover faster than 1 m/s fills the sphere. A slower vehicle takes smaller steps (LookAhead).
inline constexpr Duration kTrackBoxReach{4'000'000};
/// The least step in which a hold is tested, s. It keeps the number of hulls small where Δt is shorter.
inline constexpr double kHoldStep = 0.1;
/// Configured holds are limited to half the horizon, or to this if it is longer, s.
inline constexpr double kMinHold = 0.1;

// ---- The local goal and the way to it (course.h, look_ahead.h, planner.cpp)

/// Largest radius of a local goal as a share of r. The margin to the sphere is for rounding and for MINVO points, which
/// bulge beyond the curve.
inline constexpr double kLocalGoalShare = 0.985;
/// Ratio between successive radii of the local goal.
inline constexpr double kRadiusShrink = 5.0 / 6.0;
/// Least radius of a local goal, m. In kMinHorizon even the gentlest vehicle flies farther from rest to rest.
inline constexpr double kMinRadius = 1e-4;
/// Static obstacles are grown by this for paths, m. Plans are separated by hulls, which need a little room.
inline constexpr double kPathSpacing = 0.02;
/// A path counts as straight if the straight line is at most this much shorter, and at most this much dearer, m.
inline constexpr double kBendIgnored = 0.15;
/// A vehicle at rest without a plan tries this many smaller steps, each shorter by this factor.
inline constexpr int kSmallerSteps = 3;
inline constexpr double kSmallerStep = 3.0;
/// A candidate makes progress if it covers more than this share of the distance to the local goal.
inline constexpr double kMinProgress = 0.01;

// ---- The search's lengths for near local goals (look_ahead.h)

/// The configured lengths of the search apply to local goals at least kFullStep (m) and at most kFullStepTime (s) away.
inline constexpr double kFullStep = 2.0;
inline constexpr double kFullStepTime = 4.0;
/// Pruning merges velocities that differ by less than this share of the step's mean speed.
inline constexpr double kCoarseVelocityShare = 0.4;

// ---- The search (semantic_a_star.h, step_reach.h)

/// A child aims at most this share of r away, so that its curve, with its bulge, is within S.
inline constexpr double kSphereShare = 0.97;
/// The last band of the cost-to-go is divided into this many, so that plans end at the goal itself.
inline constexpr std::int64_t kFinerBands = 10;
/// If a step needs too much thrust, it is tried at these shares of the distance back to the steady range.
inline constexpr double kReturnShares[] = {0.25, 0.5, 0.75, 1.0};

// ---- Paths around static obstacles (goal_field.h)

/// Passes in which a path is tightened, and halvings of the pull at one vertex.
inline constexpr int kTightenPasses = 3;
inline constexpr int kPullHalvings = 6;

/// A way is flown at this share of v_max on the whole.
inline constexpr double kCruiseShare = 0.9;
/// Information is prepared this far around textures, m. From a height of 1 m the ground is seen as far.
inline constexpr double kAroundTexture = 8.0;
/// Places up to this far above start and goal are looked at, in layers at least this far apart, m.
inline constexpr double kHigherPlaces = 6.0;
inline constexpr double kLeastLayer = 0.4;

// ---- Comparing candidates (course.h, preference.h, stop_rule.h)

/// How long a trajectory is assumed to be flown before the next plan: max(min_s, share · Course::step_s). The share
/// matters where a step takes minutes.
struct FlownTime {
  double min_s;  ///< s
  double share;  ///< of the step
};
inline constexpr FlownTime kFlownTimes[] = {{0.3, 0.15}, {0.8, 0.4}};
/// Duration of the chords that represent the curve in semantic costs, s. They leave it by at most a_max·kChord²/8, some
/// centimetres.
inline constexpr double kChord = 0.1;
/// An optimized trajectory may arrive this much later than the leaf, and a departure from rest this much later than
/// staying, s.
inline constexpr double kMaxArrivalLoss = 0.05;
/// Below this Δt arrivals say little, and one step may cross the sphere.
inline constexpr Duration kShortInterval{40'000};
/// Below kShortInterval an optimized trajectory must keep this share of the leaf's progress.
inline constexpr double kMinProgressKept = 0.5;
/// A departure from rest ends nearer to the local goal by at least this, m. Two ends nearer to each other than this
/// count as one.
inline constexpr double kMinApproach = 1e-6;
/// Once a candidate that holds ends this near to the local goal, no longer duration is tried, m.
inline constexpr double kAtLocalGoal = 1.0;

// ---- Nearer local goals (nearer_goals.h)

/// Ratio between successive radii, and the least of them, m.
inline constexpr double kNearerStep = 0.75;
inline constexpr double kNearestGoal = 0.08;
/// Limits of radii that are searched, and of durations for each.
inline constexpr int kNearerTries = 3;
inline constexpr std::size_t kNearerDurations = 2;
/// Number of steps in which the way to a local goal is tested before it is searched.
inline constexpr int kNearerSamples = 16;

// ---- Reduced assurance (assurance.h, schedule.h, stop_rule.h)

/// How long α at the full level grows, in side-step times.
inline constexpr double kGrowthTimes[] = {2.0, 1.0};
/// The levels of α that follow; they grow for one side-step time.
inline constexpr int kReducedLevels[] = {2, 4};
/// The scales of the lowest level's α that follow; they grow for one side-step time.
inline constexpr double kAlphaScales[] = {0.8, 0.6, 0.45, 0.35, 0.25};
/// Limits of nodes expanded per duration, in all and after the first leaf. Several such searches share the budget.
inline constexpr int kReducedExpansions = 300;
inline constexpr int kReducedHoldExpansions = 100;
/// A candidate settles the assurance if it holds and covers at least this share of the distance to the local goal.
inline constexpr double kMinSettledProgress = 0.25;
/// A vehicle whose stop holds waits (1 − c)·kMaxWaitAtRest before it departs at confidence c, s.
inline constexpr double kMaxWaitAtRest = 1.0;

// ---- A multirotor's thrust (safety/thrust_set.h, search/step_reach.h, optimization/convex_problem.h)

/// Plans lower the vertical part of the thrust by at most this share of g, and by half of that where rest must remain
/// reachable.
inline constexpr double kThrustDip = 0.5;
/// In Eq. 4 the vertical part of the thrust keeps this share of the leaf's at each knot. The bound on jerk relies on
/// it.
inline constexpr double kMinThrustKept = 0.8;

// ---- The budget by the clock (app/planner_node.h)

/// Shares of the time from the request's arrival to the watchdog. After the first no new duration begins, after the
/// second the search ends, after the third optimizer and evasion end.
inline constexpr double kAttemptShare = 0.3;
inline constexpr double kSearchShare = 0.42;
inline constexpr double kOptimizationShare = 0.85;

// ---- Evasion (evasion.h)

/// Limits of stops that are searched for, and of nodes expanded for each.
inline constexpr int kMaxStops = 40;
inline constexpr int kStopExpansions = 150;
/// Durations of stops as multiples of min_duration(): the slow pace, and the quickest that a far stop allows. The quick
/// pace helps among declared movers. Among estimated ones, whose boxes grow, it leads to where little is known.
inline constexpr double kStopPaces[] = {kStopScale, 1.15};
/// Distances of stops in widths of vehicle and largest mover together; those beyond this share of r are left out.
inline constexpr double kStopWidths[] = {0.3, 0.6, 1.1, 2.0};
inline constexpr double kMaxWidthShare = 0.9;
/// Distances of far stops in r.
inline constexpr double kStopShares[] = {0.35, 0.8};
/// Step and greatest length of the forecast, s.
inline constexpr double kForecastStep = 0.05;
inline constexpr double kMaxForecast = 20.0;

// ---- A start inside a hull (start_clearance.h)

/// A scaled α leaves this much room at the start, m. Touching is not enough: the hull of the first interval moves on.
inline constexpr double kStartSlack = 1e-3;

// ---- Eq. 4 (convex_problem.h, barrier_solver.h)

/// A limit is a constraint only if x0 is nearer to it than this times the limit.
inline constexpr double kLimitReach = 1.5;
/// The bound on jerk is at least this times the jerk of x0, so that x0 lies strictly inside.
inline constexpr double kJerkRoom = 1.001;
/// The least first slack of the barrier method, m.
inline constexpr double kMinFirstSlack = 0.1;
/// A step covers at most this share of the distance to the nearest bound. Below kMinStep the solver has failed.
inline constexpr double kStepShare = 0.995;
inline constexpr double kMinStep = 1e-8;
/// The first barrier parameter as a share of the possible gain, the last as a share of the tolerance. Both are divided
/// by the number of constraints.
inline constexpr double kFirstBarrierShare = 0.1;
inline constexpr double kLastBarrierShare = 0.3;

// ---- Headings (heading/)

/// Width of the cells in which the search merges yaws, as a number of cells of a full turn.
inline constexpr int kYawCells = 72;
/// The grid has at least this many rates up to the largest one.
inline constexpr double kRateSteps = 4.0;
/// Slope of the cost of a direction beyond the edge of the view, per half width of the view.
inline constexpr double kBeyondView = 0.1;
/// Cost of turning, m per rad²/s: a turn at 2 rad/s costs 0.2 m each second.
inline constexpr double kTurnCost = 0.05;
/// The way ahead is looked at for this time and the time to stop, s.
inline constexpr double kSightAhead = 1.0;
/// Number of places at which the way ahead is looked at.
inline constexpr int kPathPlaces = 6;
/// Places nearer than this have no direction, m.
inline constexpr double kNearestPlace = 0.3;
/// A slower vehicle is treated as if it flew at this speed, m/s.
inline constexpr double kLeastPathSpeed = 0.5;
/// Step and number of the times at which the plan's distance to tracks is tested, s.
inline constexpr Duration kTrackStep{250'000};
inline constexpr int kTrackSteps = 12;
/// The worth of a track takes at most this α, m.
inline constexpr double kAlphaCap = 1.5;
/// The worth of a track falls by e per this distance from the plan (m), and per this time (s).
inline constexpr double kTrackReach = 1.0;
inline constexpr double kTrackSoon = 1.5;
/// Number of tracks that are looked at.
inline constexpr std::size_t kTracksSeen = 8;
/// m·s of α per m of path. All tracks that are looked at weigh at most as much as the path of a slow vehicle. So the
/// way of a fast one comes first, and tracks turn the view of one that waits.
inline constexpr double kPathWeight = static_cast<double>(kTracksSeen) * kAlphaCap / kLeastPathSpeed;

/// Number of directions in which unseen space is tested.
inline constexpr int kUnseenBearings = 72;
/// Unseen space begins up to this before a wall that is seen: cells, and the errors of depths along it, m.
inline constexpr double kUnseenBefore = 0.3;
/// m of path per m of the way of unseen movers. Those of 2 m/s all around weigh as much as the path of a slow vehicle.
/// With kPathWeight, the camera looked aside in flight, and the vehicle flew into what it had not seen ahead.
inline constexpr double kUnseenWeight = 1.0;
/// Share of `wait_s` in which a vehicle that waits looks around. Then it looks ahead again.
inline constexpr double kLooksAroundShare = 0.5;

/// Growth of the error is capped at that after this much darkness, s: for a plan, so much is ahead.
inline constexpr double kTextureDark = 2.0;
/// The σ at which growth of variance is turned into growth of σ, m: that of a flight over some tens of metres.
inline constexpr double kTextureSigma = 0.25;

}  // namespace tern
