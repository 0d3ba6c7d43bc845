// What a flight is made from, before it is flown: the scenario by name, the campaign it belongs to, its world spelt
// out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_record.h"
#include "campaign/virtual_system.h"
#include "core/base/result.h"
#include "runtime/config.h"

namespace tern {

/// All flights of a campaign but for their seeds.
struct FlightInputs {
  std::string scenario_file;
  std::vector<std::string> overrides;  ///< key=value, in order; none of `seed`
  Charge charge = Charge::Cpu;

  /// The overrides, and the seed's last.
  [[nodiscard]] std::vector<std::string> with_seed(std::uint64_t seed) const;
};

/// The path of a scenario: a file, or a name in ./scenarios, in the source tree's scenarios folder, or in
/// share/tern/scenarios beside an installed program. The source tree is the one from which the program was built (for
/// build/PRESET/bin/PROGRAM: three folders up).
/// @return an Error that lists the names that there are.
Result<std::string> find_scenario(const std::string& wanted);

/// The scenario, and the section of every process, whoever flies. @throws ConfigError.
void read_every_section(ConfigDocument& document);

/// Reads all that a flight would read, and makes the world of the seed. @throws ConfigError for what run_process would
/// refuse.
CampaignIdentity check_inputs(const FlightInputs& inputs, std::uint64_t seed);

/// A scenario file that makes the same flight wherever it lies, on this host. Every obstacle of the seed's world is
/// listed, every process's section complete, files of points by absolute paths.
/// @throws ConfigError as check_inputs.
std::string spell_out(const FlightInputs& inputs, std::uint64_t seed);

}  // namespace tern
