// Where the plans of one request head, and when a trajectory gets there.
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
  double step_s = 0.0;  ///< planned_duration() to the local goal; 0: it heads nowhere
  Limits pace;          ///< what arrivals are estimated by: the plan's limits, paced() over the way to the local goal
  const SemanticFields* fields = nullptr;  ///< what is weighed on the way; null: no semantics
};

/// Stays where it is: for a vehicle that is told to hold or stop, or knows no path.
Course course_in_place(const Surroundings& near);

/// Along a path around static obstacles, with the local goal at the largest radius that local_goal_along() allows. The
/// way leads to the farthest corner of the path to which the straight line is hardly longer, or costlier. So small
/// bends around posts are left to the search. The way into a window, out of a trap or around a region leads over its
/// corners.
/// @pre path is not empty
Course course_along(const std::vector<Vec3>& path, const TravelCost& cost, double largest_radius,
                    const Surroundings& near);

/// The same by way of its local goal, whatever regions cost: for small steps of who found no other.
Course course_to_local_goal(Course course);

/// By how much of the way from there to the local goal the trajectory's end gets nearer to it.
double progress_share(const Vec3& from, const Vec3& local_goal, const TimedSpline& trajectory);

/// What regions cost on the way to the local goal. @pre fields is not null
SemanticGuide guide_of(const Surroundings& near, const Course& course);

/// When the goal would be reached if the trajectory were flown for a while and the rest time-optimally, per axis. It is
/// the mean over two such whiles. Comparing ends instead would favour short plans, because every plan brakes at its end
/// and hardly one is flown so far.
/// @param from  the time on the trajectory that counts as 0
double arrival_estimate(const Course& course, const TimedSpline& trajectory, UTime from);

/// The score, s: the arrival estimate from t_s on, plus the exposure cost over the same whiles and ahead
/// (SemanticGuide), flown at v_max. That trades metres for metres as the search does. The mean distance stays out: it
/// has no exchange rate to seconds (flights of paper_repel took 0.3 s longer with it).
double arrival_with_exposure(const Surroundings& near, const Course& course, const TimedSpline& trajectory);

}  // namespace tern
