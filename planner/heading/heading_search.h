// The path of least cost through headings × knots.
#pragma once

#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/world/heading.h"
#include "planner/heading/look_term.h"

namespace tern {

/// The first two control points of a heading. They fix yaw and rate at its start: q_0 and 3(q_1 − q_0)/Δt.
struct HeadingStart {
  double q0 = 0.0, q1 = 0.0;  ///< rad
};

/// Returns what this yaw costs per second: Σ worth · c(angle / half_view) over the targets, where
///
///     c(x) = x²   for x ≤ 1,        c(x) = 1 + kBeyondView (x − 1)   beyond the edge of the view
///
/// The cost rises from the centre of the view outwards: at its edge, a prediction error or a turn loses the target. It
/// rises beyond the edge as well: a plan that is too short to bring a target into view turns towards it at least.
/// @param half_view  half of the horizontal field of view, rad, > 0; a target may have its own
double unseen_cost(double yaw, const std::vector<LookTarget>& targets, double half_view);

/// Returns the span of the i-th control point of a clamped cubic spline's derivative: q_{i+1} − q_i = w_i · span_i, s.
/// @pre 0 ≤ i ≤ J + 1, J ≥ 4
double rate_span(int i, int intervals, double interval_s);

/// Returns the control points of the cheapest yaw that the search finds, J + 3 of them.
///
/// Let w_i be the control points of the yaw rate. The rate lies in their hull. The acceleration is linear between the
/// knots, where it is a quotient of differences of the w_i. So the spline keeps its limits everywhere if
///
///     |w_i| ≤ ω_max,   |w_{i+1} − w_i| ≤ α_max Δt   (half of it for the first and the last difference),   w_{J+1} = 0
///
/// The search chooses w_1 … w_J from a grid of rates and minimizes
///
///     Σ_i span_i · ( unseen_cost(q_{i+1}) + kTurnCost w_i² )
///
/// States of one rate whose yaws lie in one of kYawCells cells are merged, and the cheaper one remains. Each state
/// keeps its own yaw: a merge may cost quality, but it cannot break a limit. Ties are broken by index. O(J · kYawCells
/// · rates · changes of the rate).
/// @param targets  per control point, weights applied; at least 7 lists
/// @return nullopt if the start turns faster than the limit, or too fast to stop turning within the plan
std::optional<std::vector<double>> search_heading(const HeadingStart& start, Duration interval,
                                                  const std::vector<std::vector<LookTarget>>& targets,
                                                  const HeadingLimits& limits);

}  // namespace tern
