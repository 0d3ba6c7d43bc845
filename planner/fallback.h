// The committed trajectory, checked against the request's predictions: the first incumbent.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

struct Fallback {
  /// nullopt if it is blocked, or if obstacles are followed for less than its duration. Its arrival is not set.
  std::optional<Candidate> committed;
  /// The vehicle has reached its goal, and a declared or static obstacle is predicted to hit it there.
  bool is_hit_at_rest = false;
};

/// Checks the committed trajectory from t_s on, and then its end point for the hold.
/// @param has_reached_goal  the vehicle only has to stay clear
Fallback check_committed(const Surroundings& near, bool has_reached_goal, PlanTools& tools);

}  // namespace tern
