// What charts and the flown path are drawn from: a flight's past, thinned, in bounded memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/types.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"

namespace tern {

/// How far back the charts reach.
inline constexpr Duration kChartSpan{30'000'000};

/// Keeps at most one vehicle sample per 50 ms, one clearance per 100 ms and every answer's cost; when a row is full
/// (six hours of flight), it forgets its older half. Times are the vehicle's clock; what comes out of order is left
/// out.
class FlightHistory {
 public:
  void add(const UavState& state);
  /// @param clearance_m  from the body to the nearest obstacle, negative in overlap
  void add_clearance(UTime at, double clearance_m);
  /// @param allowed_ms  from the request to its deadline; 0: unknown
  void add_answer(UTime at, double total_ms, double allowed_ms, PlanOutcome outcome);
  void clear();

  /// {"until_us": …, "elapsed_s": since the first state, "motion": [[t…], [speed…], [acceleration…]], "clearance":
  /// [[t…], [m…]],
  ///  "answers": [[t…], [ms…], [allowed ms…], [outcome…]]} of the last 30 s before `until`, t in seconds, ≤ 0.
  [[nodiscard]] std::string chart_json(UTime until) const;
  /// [x, y, z, speed, …] from the start to `until`, at most `most` points.
  [[nodiscard]] std::string path_json(UTime until, std::size_t most = 3'000) const;

 private:
  struct Motion {
    UTime at;
    Vec3 p;
    double speed, acceleration;
  };
  struct Clearance {
    UTime at;
    double metres;
  };
  struct Answer {
    UTime at;
    double total_ms, allowed_ms;
    int outcome;
  };
  std::vector<Motion> motion_;
  std::vector<Clearance> clearance_;
  std::vector<Answer> answers_;
};

}  // namespace tern
