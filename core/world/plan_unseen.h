// The message PLAN_UNSEEN: how long a plan is clear of movers that no sensor has seen.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/wire/header.h"
#include "core/wire/message_limits.h"

namespace tern {

/// PLAN_UNSEEN: the times to contact of a request's committed trajectory and of the plan that answers it
/// (docs/planner/unseen.md). They follow from what was known when the request arrived. kMaxSpan: the trajectory is
/// passively safe.
struct PlanUnseen {
  Header header;
  std::int64_t request_id = 1;         ///< of the plan
  MessageName request;                 ///< the request that the plan answers
  UTime start;                         ///< t_s of the request, from which the times count
  Duration committed_clear{kMaxSpan};  ///< [0, kMaxSpan]
  Duration plan_clear{kMaxSpan};       ///< [0, kMaxSpan]; of NoPlan and KeepCommitted: as committed_clear
};

}  // namespace tern
