#include "campaign/records/distinct_flights.h"

#include <cmath>

namespace tern {

void DistinctFlights::add(const FlightRecord& flight) {
  const FlightResult& r = flight.result;
  if (std::isnan(r.flight_time_s)) {
    ++unjudged_;
    return;
  }
  const auto value = [](double x) { return std::isnan(x) ? HUGE_VAL : x; };
  judged_.insert(
      {r.outcome, r.flight_time_s, value(r.path_length_m), value(r.min_clearance_m), value(r.jerk_integral)});
}

}  // namespace tern
