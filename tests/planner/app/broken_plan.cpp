// plan() as it must never be: linked in place of the real one into a planner process whose end is tested. A request
// with id 1 is never answered, any other one throws.
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
