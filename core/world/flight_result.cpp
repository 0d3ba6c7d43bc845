#include "core/world/flight_result.h"

namespace tern {

const char* to_string(FlightOutcome outcome) {
  switch (outcome) {
    case FlightOutcome::Reached: return "reached";
    case FlightOutcome::Collision: return "collision";
    case FlightOutcome::Timeout: return "timeout";
    case FlightOutcome::Failed: return "failed";
  }
  return "failed";
}

}  // namespace tern
