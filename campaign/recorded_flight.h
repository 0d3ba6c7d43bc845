// One flight of a campaign, with the summary of tern-monitor and the log of tern-logger.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "campaign/flight_inputs.h"
#include "campaign/records/flight_record.h"

namespace tern {

/// Thrown if a file of the flight cannot be written, or if the folder holds a log already. The campaign then ends with
/// an error, and its next call flies the seed again.
class CannotRecord : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The exit code of a flight's process and of the campaign if a file cannot be written.
inline constexpr int kExitCannotWrite = 3;

/// A program that reads each flight's log. It is run as "PROGRAM LOG --json FILE", as tern-audit is. The flight's
/// record takes coverage (key coverage_sums) and tracking (measures of check "tube") from FILE. Exit code 0 means
/// passed, 1 broken, 3 incomplete, 4 not judged; any other end means failed.
struct Auditor {
  std::string program;  ///< empty: none
  bool judges = true;   ///< true: the verdict is recorded; false: only the verdict "failed" is
};

/// Observes a flight. Called with every request and every plan.
struct FlightObserver {
  virtual ~FlightObserver() = default;
  virtual void on_request(const HorizonRequest&) {}
  virtual void on_plan(const Plan&) {}
};

/// The result of one flight.
struct RecordedFlight {
  FlightRecord record;
  FlightTimes times;
  std::map<std::string, std::string> said;  ///< FlightSummary::said
};

/// Flies one seed and writes three files to `folder`, which must exist and hold no flight.lcm:
///
/// - scenario.yaml (spell_out()), before the flight, so that it survives a crash
/// - flight.lcm: every message, with virtual times
/// - summary.json, as tern-monitor writes it
/// @param auditor  its output goes to audit.txt and audit.json
/// @throws ConfigError for bad inputs; CannotRecord
RecordedFlight fly_recorded(const FlightInputs& inputs, std::uint64_t seed, const CampaignIdentity& identity,
                            const std::string& folder, const Auditor& auditor, FlightObserver* observer = nullptr);

/// Returns "Intel(R) Xeon(R) CPU @ 2.20GHz, 2 cores".
std::string machine_name();

/// Returns "GNU 12.2.0 Release".
std::string compiler_name();

}  // namespace tern
