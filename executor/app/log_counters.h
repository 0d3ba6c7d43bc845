// The counters of an executor as lines of its log.
#pragma once

#include "executor/committed_heading.h"
#include "executor/executor.h"

namespace tern {

/// Logs requests, and the plans and headings of each verdict.
void log_counters(const ExecutorCounters& counters, const HeadingCounters& headings);

}  // namespace tern
