#include "planner/passive_safety.h"

namespace tern {

double contact_time(const Surroundings& near, const TimedSpline& trajectory) {
  if (near.unseen == nullptr) return kNoContact;
  const HorizonRequest& request = near.request;
  if (trajectory.end() <= request.t_s) {
    return time_at_rest_s(request) > near.config.unseen_movers.wait_s ? 0.0 : kNoContact;
  }
  return first_contact(*near.unseen, trajectory, request.t_s, upright_radius(request.body));
}

}  // namespace tern
