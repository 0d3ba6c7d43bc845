// One flight of a campaign: flown, watched as tern-monitor watches, recorded as tern-logger records.
#pragma once

#include <stdexcept>
#include <string>

#include "campaign/flight_inputs.h"
#include "campaign/records/flight_record.h"

namespace tern {

/// The disk did not take what a flight has to leave: no flight's fault.
class CannotRecord : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The exit code of a flying process that says so, and of a campaign that ends for it.
inline constexpr int kExitCannotWrite = 3;

/// A program that looks at each flight's log afterwards: "tern-audit LOG --json FILE". From FILE comes what it says of
/// coverage (its key coverage_sums) and of tracking (measures of its check "tube"); a program that writes none says
/// nothing.
struct Auditor {
  std::string program;  ///< empty: none
  bool judges =
      true;  ///< its exit code is a verdict: 0 passed, 1 broken; anything else failed, whether it judges or not
};

/// Watches a flight from outside: called with every plan and its request.
struct FlightObserver {
  virtual ~FlightObserver() = default;
  virtual void on_request(const HorizonRequest&) {}
  virtual void on_plan(const Plan&) {}
};

struct RecordedFlight {
  FlightRecord record;
  FlightTimes times;
};

/// Flies one seed. Three files go into `folder`, which must exist: flight.lcm (every message, with virtual times),
/// summary.json (tern-monitor's) and scenario.yaml (spell_out). The last is written before the flight, so that a crash
/// leaves it.
/// @param auditor  its output goes into audit.txt and audit.json
/// @throws ConfigError for bad inputs; CannotRecord.
RecordedFlight fly_recorded(const FlightInputs& inputs, std::uint64_t seed, const CampaignIdentity& identity,
                            const std::string& folder, const Auditor& auditor, FlightObserver* observer = nullptr);

/// "Intel(R) Xeon(R) CPU @ 2.20GHz, 2 cores".
std::string machine_name();

/// "GNU 12.2.0 Release".
std::string compiler_name();

}  // namespace tern
