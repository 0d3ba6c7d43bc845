// The committed trajectory, checked against the request's predictions: the first incumbent.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

/// Checks the committed trajectory from t_s on, and then its end point for the hold, at the assurance of the
/// surroundings.
/// @return nullopt if it is blocked, or if obstacles are followed for less than its duration. The values that depend on
/// a course are not set.
std::optional<Candidate> check_committed(const Surroundings& near, PlanTools& tools);

}  // namespace tern
