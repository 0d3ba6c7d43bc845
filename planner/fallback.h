// The committed trajectory against these predictions: what stands before anything new is found.
#pragma once

#include <optional>

#include "planner/attempt.h"

namespace tern {

struct Fallback {
  std::optional<Candidate> committed;  ///< nullopt: it is not clear, or not known to its end; its arrival is not set
  /// The vehicle rests where it was told to, and a promised motion comes through it.
  bool is_hit_at_rest = false;
};

/// From t_s on, with the hold of its end. @param has_reached_goal  nothing to do but to stay clear
Fallback check_committed(const Surroundings& near, bool has_reached_goal, PlanTools& tools);

}  // namespace tern
