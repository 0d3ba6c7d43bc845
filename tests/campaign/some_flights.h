// Made-up flight records, for tests of tables and summaries.
#pragma once

#include <string>

#include "campaign/records/flight_record.h"

namespace tern {

/// A flight that depends only on the seed; every third one collided.
inline FlightRecord some_flight(std::uint64_t seed) {
  const double x = static_cast<double>(seed);
  FlightRecord flight;
  flight.identity = {"here, \"there\"", 100, "cpu", "0123456789abcdef", "0.1.0+abc"};
  flight.seed = seed;
  flight.result.outcome = seed % 3 == 0 ? FlightOutcome::Collision : FlightOutcome::Reached;
  flight.result.detail = seed % 3 == 0 ? "hit \"mover 7\",\nat 3 m/s" : "";
  flight.result.flight_time_s = 13.0 + x / 7.0;
  flight.result.first_entry_s = 12.9 + x / 7.0;
  flight.result.mean_speed_mps = 5.0 + 1.0 / x;
  flight.result.min_clearance_m = seed % 3 == 0 ? -1e-3 / x : 1e-3 / x;
  flight.result.jerk_integral = 1e4 / x;
  flight.result.stops = static_cast<std::int64_t>(seed % 2);
  flight.result.exposure = {{"a \"pond\", wet", x / 3.0, x / 9.0, x / 2.0, x}};
  flight.requests = 260;
  flight.answered_in_time = 259;
  flight.plans = {200, 30, 20, 5, 4};
  flight.reasons = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  flight.replan_ms.total = {12.001, 15.5, 17.0, 20.25};
  flight.passively_safe_share = seed % 2 == 0 ? 1.0 - 0.1 / x : Tracking::kNone;
  flight.messages["PLAN"] = {260, 1, 2};
  flight.tracking = {0.05, 0.125, 0.25, 0.1 / x};
  flight.coverage.confidence = 0.99;
  flight.coverage.intervals[{PredictionClass::Old, 1}] = {100, {98, 97, 95, 90, 70}, 12.5};
  flight.coverage.claims[2] = {10, 9};
  return flight;
}

inline FlightTimes some_times(std::uint64_t seed) {
  FlightTimes times;
  times.seed = seed;
  times.machine = "a machine, 2 cores";
  times.compiler = "GNU 12";
  for (int k = 1; k <= 100; ++k) times.times[0].add(0.25 * k * static_cast<double>(seed));
  return times;
}

}  // namespace tern
