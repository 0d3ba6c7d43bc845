// A broken plan(), linked into a planner process in place of the real one, to test how the process ends. For a request
// with id 1 it never returns; for any other it throws.
#include <future>
#include <stdexcept>

#include "planner/planner.h"

namespace tern {

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld&, const PlannerConfig&, Budget&, PlanWorkspace&,
                PlanObserver*) {
  if (request.id == 1) std::promise<void>().get_future().wait();
  throw std::runtime_error("a list of 99 pieces, at most 48");
}

}  // namespace tern
