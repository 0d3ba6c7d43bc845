// Many flights of one scenario, several at once, each in a process of its own; ended at any moment, it goes on later.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaign/flight_inputs.h"
#include "campaign/records/flight_table.h"

namespace tern {

/// Of `count` shards the index-th, from 1: every count-th seed.
struct Shard {
  int index = 1, count = 1;
};

struct CampaignOptions {
  FlightInputs inputs;
  std::uint64_t first_seed = 1, last_seed = 1;  ///< both flown
  Shard shard;
  int jobs = 1;                     ///< flights at once, ≥ 1
  std::string out;                  ///< FLIGHTS.csv
  std::string failures;             ///< folder for what failed; made when something does
  std::string audit;                ///< program to run on each log; empty: none
  std::int64_t cpu_limit_s = 1800;  ///< a flight that takes more has failed
};

/// How far a campaign is.
struct CampaignProgress {
  std::int64_t total = 0;      ///< flights of this call's seeds
  std::int64_t done = 0;       ///< of these, in the book
  std::int64_t successes = 0;  ///< of those
  std::int64_t different = 0;  ///< of those, flights that differ from each other (DistinctFlights)
  std::int64_t flown = 0;      ///< by this call
};

enum class CampaignEnd { Complete, Interrupted };

/// The seeds of the options' shard, ascending.
std::vector<std::uint64_t> seeds_of(const CampaignOptions& options);

/// Flies every seed that is not in options.out yet, and puts each into it as it ends; when all are there, the lines are
/// sorted. A flight that is no success keeps its folder, failures/seed-N: scenario.yaml, flight.lcm, summary.json,
/// flight.log. A flight whose process dies has failed. Ends early when `stop_fd` becomes readable, or when somebody
/// ends a flight's process (SIGINT, SIGTERM, SIGHUP). Flights in the air are dropped then, and flown from their
/// beginning by the next call.
/// @param flight_command  program and first arguments of a process that flies, prints encode_flight() and ends with
/// exit code 0; "--seed N --folder DIR" is added
/// @param report  called at the start, after every flight and at least once a second
/// @return how it ended; an Error when the book or a log cannot be written, or the book is another campaign's.
/// @throws ConfigError for bad inputs, before anything is written.
Result<CampaignEnd> run_campaign(const CampaignOptions& options, const std::vector<std::string>& flight_command,
                                 int stop_fd, const std::function<void(const CampaignProgress&)>& report);

/// What a flying process writes to standard output: two lines of CSV.
std::string encode_flight(const FlightRecord& record, const FlightTimes& times);

/// "FLIGHTS.csv.failures".
std::string default_failures(const std::string& out);

}  // namespace tern
