// How many flights differ from each other: those that a seed does not change are one flight, flown often.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include "campaign/records/flight_record.h"

namespace tern {

/// Flights differ in outcome, time, way, clearance or jerk. Those that nobody judged count as different.
class DistinctFlights {
 public:
  /// O(log n).
  void add(const FlightRecord& flight);
  [[nodiscard]] std::int64_t count() const { return unjudged_ + static_cast<std::int64_t>(judged_.size()); }

 private:
  std::set<std::tuple<FlightOutcome, double, double, double, double>> judged_;
  std::int64_t unjudged_ = 0;
};

}  // namespace tern
