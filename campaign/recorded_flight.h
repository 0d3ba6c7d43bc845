// One flight of a campaign: flown, watched as tern-monitor watches, recorded as tern-logger records.
#pragma once

#include <stdexcept>
#include <string>

#include "campaign/flight_inputs.h"
#include "campaign/records/flight_record.h"
#include "campaign/virtual_flight.h"

namespace tern {

/// The disk did not take what a flight has to leave: no flight's fault.
class CannotRecord : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The exit code of a flying process that says so, and of a campaign that ends for it.
inline constexpr int kExitCannotWrite = 3;

struct RecordedFlight {
  FlightRecord record;
  FlightTimes times;
};

/// Flies one seed. Three files go into `folder`, which must exist: flight.lcm (every message, with virtual times),
/// summary.json (tern-monitor's) and scenario.yaml (spell_out). The last is written before the flight, so that a crash
/// leaves it.
/// @param audit  a program to run on the log, "tern-audit LOG", with its output in audit.txt: exit code 0 passed,
/// 1 broken, anything else failed. Empty: none
/// @throws ConfigError for bad inputs; CannotRecord.
RecordedFlight fly_recorded(const FlightInputs& inputs, std::uint64_t seed, const CampaignIdentity& identity,
                            const std::string& folder, const std::string& audit, FlightObserver* observer = nullptr);

/// "Intel(R) Xeon(R) CPU @ 2.20GHz, 2 cores".
std::string machine_name();

/// "GNU 12.2.0 Release".
std::string compiler_name();

}  // namespace tern
