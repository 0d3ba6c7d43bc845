// Flies many seeds of one scenario in parallel processes. A campaign can be interrupted and resumed at any time.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaign/flight_inputs.h"
#include "campaign/records/flight_table.h"

namespace tern {

/// One of the `count` parts of a campaign's seeds: every count-th seed, from the index-th on (1 ≤ index ≤ count).
struct Shard {
  int index = 1, count = 1;
};

/// The flights of a campaign, and the files for its results.
struct CampaignOptions {
  FlightInputs inputs;
  std::uint64_t first_seed = 1, last_seed = 1;  ///< first and last seed, both flown
  Shard shard;
  int jobs = 1;                     ///< concurrent flights, ≥ 1
  std::string out;                  ///< FLIGHTS.csv
  std::string failures;             ///< folder for failed flights; created with the first one
  std::string audit;                ///< program to run on each log; empty: none
  std::int64_t cpu_limit_s = 1800;  ///< a flight that needs more CPU time counts as failed
};

/// The progress of a campaign.
struct CampaignProgress {
  std::int64_t total = 0;      ///< seeds of this call
  std::int64_t done = 0;       ///< seeds of this call whose flights are in the table
  std::int64_t successes = 0;  ///< successful flights among the done ones
  std::int64_t different = 0;  ///< distinct flights among the done ones; equal flights count once (DistinctFlights)
  std::int64_t flown = 0;      ///< flights flown by this call
};

enum class CampaignEnd { Complete, Interrupted };

/// Returns the seeds of the options' shard, ascending.
std::vector<std::uint64_t> seeds_of(const CampaignOptions& options);

/// Flies every seed that is missing in options.out, and adds each flight as it ends. When all are there, the lines are
/// sorted by seed.
///
/// | event                                              | effect                                                   |
/// |----------------------------------------------------|----------------------------------------------------------|
/// | a flight is not a success                          | keeps its folder failures/seed-N, with log and summary   |
/// | a flight's process crashes or exits with an error  | the flight is recorded as failed                         |
/// | a file of a flight cannot be written               | kills running flights and returns an Error               |
/// | `stop_fd` becomes readable                         | kills running flights, which the next call flies again   |
/// | SIGINT, SIGTERM or SIGHUP ends a flight's process  | as for `stop_fd`                                         |
///
/// @param flight_command  program and first arguments of a process that flies, prints encode_flight() and ends with
/// exit code 0; "--seed N --folder DIR" is appended
/// @param report  called at the start, after every flight and at least once a second
/// @return how it ended; an Error if the table or a log cannot be written, or the table belongs to another campaign
/// @throws ConfigError for bad inputs, before anything is written
Result<CampaignEnd> run_campaign(const CampaignOptions& options, const std::vector<std::string>& flight_command,
                                 int stop_fd, const std::function<void(const CampaignProgress&)>& report);

/// Encodes what a flight's process prints on standard output: two lines of CSV.
std::string encode_flight(const FlightRecord& record, const FlightTimes& times);

/// Returns the default folder: "FLIGHTS.csv.failures".
std::string default_failures(const std::string& out);

}  // namespace tern
