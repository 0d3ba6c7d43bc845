// The flights behind the paper's section 6.2: worlds with one region, methods, λ, seeds; one line of CSV each.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/flight_result.h"

namespace tern {

/// A way to use regions. The paper's own is "mean_distance".
struct SemanticMethod {
  std::string name;                    ///< in CSV files
  std::string title;                   ///< in figures
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

struct SemanticCase {
  std::string world, method;
  double lambda = 0.0;  ///< 0 for "off"
  std::uint64_t seed = 1;
  friend bool operator==(const SemanticCase&, const SemanticCase&) = default;
};

struct SemanticFlight {
  SemanticCase flown;
  FlightOutcome outcome = FlightOutcome::Failed;
  double flight_time_s = 0.0, path_length_m = 0.0, min_clearance_m = 0.0;
  Exposure exposure;    ///< of the world's one region; near includes inside
  std::string planner;  ///< build of the planner, 16 hex digits
};

/// λ on against off: both worlds, seeds 1 … seeds; off, the paper's method and the default, both with λ = 2.
std::vector<SemanticCase> on_off_cases(std::uint64_t seeds);
/// Off and every method with λ = 0.5, 1, 2, 4, 8.
std::vector<SemanticCase> sweep_cases(std::uint64_t seeds);
inline constexpr double kSweepLambdas[] = {0.5, 1.0, 2.0, 4.0, 8.0};

/// What the scenario file is overridden with. The worlds have no walls, but here they have the corridor's floor and
/// ceiling, z ∈ [0, 4]. Their regions are as high, so they must be passed at their sides.
std::vector<std::string> overrides_of(const SemanticCase& wanted);

/// Flies on virtual time in this process, 15 ms charged per answer, so that the flight is a function of its inputs.
/// @throws ConfigError for a scenario that is not there or was changed beyond use.
SemanticFlight fly_semantic_case(const SemanticCase& wanted);

struct SemanticCampaign {
  std::string file;  ///< CSV: a line after each flight, so that an ended run goes on where it was
  std::vector<SemanticCase> cases;
  /// Program and first arguments of a process that prints a flight's line; words_of(case) is added.
  std::vector<std::string> command;
  int jobs = 1;                                          ///< processes at once, ≥ 1
  std::function<void(std::size_t, std::size_t)> report;  ///< (done, all) after each flight
};

/// Flies what is not in the file yet.
/// @return all flights wanted, in their order, the file sorted likewise. An Error when the file cannot be read or
/// written, holds flights of another planner, or a process dies.
Result<std::vector<SemanticFlight>> fly_semantic_cases(const SemanticCampaign& campaign);

/// "paper_repel,exposure,2,17"
std::string words_of(const SemanticCase& wanted);
/// What words_of wrote. @return an Error for other words.
Result<SemanticCase> parse_semantic_case(const std::string& words);

std::string semantic_flight_columns();
std::string to_csv(const SemanticFlight& flight);
/// @return an Error that names what is wrong with the line.
Result<SemanticFlight> parse_semantic_flight(const std::string& line);

}  // namespace tern
