// The times of PLAN_TIMING, collected for percentiles.
#pragma once

#include <vector>

#include "core/world/horizon.h"

namespace tern {

/// Times of answers, ms. `total` holds every answer. `first_answer` and `stage` hold only answers in which the step
/// ran, because zeros of other answers would lower the percentiles.
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
