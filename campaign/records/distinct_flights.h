// Counts distinct flights. If the seed changes nothing in a scenario, all its flights are equal and count as one.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include "campaign/records/flight_record.h"

namespace tern {

/// Two flights are distinct if they differ in outcome, time, path length, clearance or jerk. Flights without a referee
/// count as different.
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
