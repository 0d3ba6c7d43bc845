// The flights behind the paper's section 6.2: worlds with one region, methods and λ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_record.h"

namespace tern {

/// A way to use regions. The paper's own is "mean_distance".
struct SemanticMethod {
  std::string name;                    ///< in CSV files
  std::vector<std::string> overrides;  ///< key=value
};
/// "off": without semantics; "exposure" and "mean_distance": the costs in the search and choice alone; "exposure+path"
/// (the default of the planner) and "mean_distance+path": the path to the goal knows regions too.
const std::vector<SemanticMethod>& semantic_methods();
/// @throws std::invalid_argument for a name that is not there.
const SemanticMethod& semantic_method(const std::string& name);

/// paper_attract or paper_repel.
struct SemanticWorld {
  std::string scenario;    ///< name of the file, without its ending
  std::string lambda_key;  ///< which λ its region has
  bool attracts;
};
const std::vector<SemanticWorld>& semantic_worlds();

/// What is flown with each seed.
struct SemanticCase {
  std::string world, method;
  double lambda = 0.0;  ///< 0 for "off"
};

struct SemanticFlight {
  SemanticCase flown;
  std::uint64_t seed = 1;
  FlightOutcome outcome = FlightOutcome::Failed;
  double flight_time_s = 0.0, path_length_m = 0.0, min_clearance_m = 0.0;
  Exposure exposure;  ///< of the world's one region; near includes inside
};
SemanticFlight semantic_flight(const SemanticCase& flown, const FlightRecord& record);

/// λ on against off, in both worlds: off, the paper's method and the default, both with λ = 2.
std::vector<SemanticCase> on_off_cases();
/// Off and every method with λ = 0.5, 1, 2, 4, 8.
std::vector<SemanticCase> sweep_cases();
inline constexpr double kSweepLambdas[] = {0.5, 1.0, 2.0, 4.0, 8.0};

/// What the scenario file is overridden with. The worlds have no walls, but here they have the corridor's floor and
/// ceiling, z ∈ [0, 4]. Their regions are as high, so they must be passed at their sides.
std::vector<std::string> overrides_of(const SemanticCase& wanted);

/// With a header.
std::string to_csv(const std::vector<SemanticFlight>& flights);

}  // namespace tern
