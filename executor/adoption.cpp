#include "executor/adoption.h"

#include "core/world/body.h"
#include "core/world/names.h"

namespace tern {

const char* to_string(Verdict verdict) {
  constexpr const char* kNames[kVerdicts] = {"adopted", "kept",     "no plan", "unknown request", "answered twice",
                                             "late",    "too late", "stopped", "unflyable"};
  return kNames[static_cast<int>(verdict)];
}

const char* to_string(const Adoption& adoption) {
  return adoption.breach == Breach::None ? to_string(adoption.verdict) : to_string(adoption.breach);
}

Adoption check_trajectory(const TimedSpline& trajectory, const HorizonRequest& request) {
  const BreachReport report = breach_of(trajectory, request.t_s, request.start, request.limits,
                                        centre_box(request.flight_box, grown(request.body, request.tube)));
  if (report.ok()) return {Verdict::Adopted, {}};
  return {Verdict::Unflyable, report.text(), report.breach};
}

}  // namespace tern
