// The counters of an executor as lines of its log.
#pragma once

#include "executor/committed_heading.h"
#include "executor/executor.h"

namespace tern {

/// Logs requests, and the plans and headings of each verdict.
void log_counters(const ExecutorCounters& counters, const HeadingCounters& headings);

/// Logs the smallest tube of requests, m, if it has changed.
void log_smallest_tube(double now_m, double before_m);

}  // namespace tern
