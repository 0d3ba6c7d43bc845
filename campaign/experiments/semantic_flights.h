// The flights of the paper's section 6.2: worlds with one region, methods and λ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_record.h"

namespace tern {

/// A way to use regions; "mean_distance" is that of the paper.
struct SemanticMethod {
  std::string name;                    ///< in CSV files
  std::vector<std::string> overrides;  ///< key=value
};
/// Returns the methods:
/// - "off": without semantics
/// - "exposure", "mean_distance": cost in the search and in the choice only
/// - "exposure+path" (the planner's default), "mean_distance+path": cost in the global path as well
const std::vector<SemanticMethod>& semantic_methods();
/// @throws std::invalid_argument for an unknown name
const SemanticMethod& semantic_method(const std::string& name);

/// A world: paper_attract or paper_repel.
struct SemanticWorld {
  std::string scenario;    ///< file name without its ending
  std::string lambda_key;  ///< the λ of its region
  bool attracts;
};
const std::vector<SemanticWorld>& semantic_worlds();

/// One case, flown with every seed.
struct SemanticCase {
  std::string world, method;
  double lambda = 0.0;  ///< 0 for "off"
};

/// The result of one flight.
struct SemanticFlight {
  SemanticCase flown;
  std::uint64_t seed = 1;
  FlightOutcome outcome = FlightOutcome::Failed;
  double flight_time_s = 0.0, path_length_m = 0.0, min_clearance_m = 0.0;
  Exposure exposure;  ///< of the world's one region; near includes inside
};
SemanticFlight semantic_flight(const SemanticCase& flown, const FlightRecord& record);

/// Returns the cases "off", the paper's method and the default in both worlds, the latter two with λ = 2.
std::vector<SemanticCase> on_off_cases();
/// Returns the cases "off", and every method with λ = 0.5, 1, 2, 4, 8.
std::vector<SemanticCase> sweep_cases();
inline constexpr double kSweepLambdas[] = {0.5, 1.0, 2.0, 4.0, 8.0};

/// Returns the overrides of a case. These worlds have no walls, so the corridor's floor and ceiling, z ∈ [0, 4], are
/// added. Regions reach from floor to ceiling, so they can only be passed at their sides.
std::vector<std::string> overrides_of(const SemanticCase& wanted);

/// With a header line.
std::string to_csv(const std::vector<SemanticFlight>& flights);

}  // namespace tern
