// What PLAN_TIMING measures, gathered for percentiles.
#pragma once

#include <vector>

#include "core/world/horizon.h"

namespace tern {

/// Times of answers, ms. `total` has every answer; `first_answer` and the stages have those answers in which they ran:
/// what was not done took no time, and would pull every percentile down.
struct ReplanSamples {
  std::vector<double> total, first_answer, stage[kStages];

  void add(const PlanTiming& timing) {
    total.push_back(timing.total_ms);
    if (timing.first_answer_ms > 0.0) first_answer.push_back(timing.first_answer_ms);
    for (int k = 0; k < kStages; ++k) {
      if (timing.stage_ms[k] > 0.0) stage[k].push_back(timing.stage_ms[k]);
    }
  }
};

}  // namespace tern
