// The course of one request: where its plans aim, and when a trajectory reaches the goal.
#pragma once

#include <vector>

#include "planner/look_ahead.h"
#include "planner/search/semantic_a_star.h"
#include "planner/semantics/semantic_guide.h"
#include "planner/surroundings.h"

namespace tern {

struct Course {
  LocalGoal local;      ///< the local goal
  CostToGo cost_to_go;  ///< to the goal, for ranking
  double step_s = 0.0;  ///< planned_duration() to the local goal, s; 0: the course stays in place
  Limits pace;          ///< for arrival estimates: the plan's limits, paced() over the distance to the local goal
  const SemanticFields* fields = nullptr;  ///< the semantics of the course; null: none
};

/// Returns the course that stays at the start: for a vehicle that is to hold or stop, or has no path.
Course course_in_place(const Surroundings& near);

/// Returns the course along a path around static obstacles. Its local goal is local_goal_along() the path.
///
/// The cost-to-go is the straight line to one corner of the path, then the rest of the path. The corner is the farthest
/// one whose straight line is at most kBendIgnored shorter than the path, and at most that much dearer. Small bends
/// around posts are thus left to the search. The path into a window, out of a trap or around a region is followed from
/// corner to corner.
/// @pre path is not empty
Course course_along(const std::vector<Vec3>& path, const TravelCost& cost, double largest_radius,
                    const Surroundings& near);

/// Returns the course that leads straight to the local goal and ignores semantics: for the smaller steps of a vehicle
/// that found no other plan.
Course course_to_local_goal(Course course);

/// Returns 1 − |local_goal − end| / |local_goal − from|: the share of the distance to the local goal that the
/// trajectory covers. Returns 0 if `from` is the local goal.
double progress_share(const Vec3& from, const Vec3& local_goal, const TimedSpline& trajectory);

/// Returns the semantic cost on the way to the local goal. @pre course.fields is not null
SemanticGuide guide_of(const Surroundings& near, const Course& course);

/// Estimates when the goal is reached, in seconds after `from`, as the mean over kFlownTimes.
///
/// Each term flies the trajectory for a time of kFlownTimes, and the rest time-optimally per axis. Comparing ends
/// instead would favour short plans: every plan brakes at its end, and few are flown that far.
double arrival_estimate(const Course& course, const TimedSpline& trajectory, UTime from);

/// Returns the arrival estimate after t_s plus the exposure cost over the same times and ahead (SemanticGuide), s.
///
/// A metre of exposure counts as the time to fly it at v_max: the same exchange rate as in the search. The mean
/// distance of Eq. 3 is left out, since it has no exchange rate to seconds.
double arrival_with_exposure(const Surroundings& near, const Course& course, const TimedSpline& trajectory);

}  // namespace tern
