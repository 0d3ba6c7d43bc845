// The inputs of a campaign's flights: a scenario and overrides of its values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_record.h"
#include "campaign/virtual_system.h"
#include "core/base/result.h"
#include "runtime/config.h"

namespace tern {

/// The inputs that all flights of a campaign share; only the seed differs.
struct FlightInputs {
  std::string scenario_file;
  std::vector<std::string> overrides;  ///< key=value, in order; `seed` is not among them
  Charge charge = Charge::Cpu;

  /// Returns the overrides, with the seed appended.
  [[nodiscard]] std::vector<std::string> with_seed(std::uint64_t seed) const;
};

/// Returns the path of a scenario. `wanted` is a file, or a name that is looked up in these folders, in this order:
///
/// 1. ./scenarios
/// 2. BIN/../../../scenarios, where BIN is the folder of the running program: the source tree of build/PRESET/bin
/// 3. BIN/../share/tern/scenarios: the scenarios of an installed program
/// @return an Error that lists the available names
Result<std::string> find_scenario(const std::string& wanted);

/// Reads the scenario and the section of every process. @throws ConfigError
void read_every_section(ConfigDocument& document);

/// Reads everything that a flight would read, and makes the world of the seed.
/// @throws ConfigError for inputs that run_process() would refuse
CampaignIdentity check_inputs(const FlightInputs& inputs, std::uint64_t seed);

/// Returns a scenario file that repeats this flight from any folder on this host. It lists every obstacle of the seed's
/// world, completes every process's section, and names point files by absolute paths.
/// @throws ConfigError as check_inputs() does
std::string spell_out(const FlightInputs& inputs, std::uint64_t seed);

}  // namespace tern
