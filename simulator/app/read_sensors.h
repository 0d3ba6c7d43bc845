// Reads the keys `sensor`, `sensors` and `ground` of the section `simulator:`.
#pragma once

#include <cstdint>

#include "runtime/config.h"
#include "simulator/app/simulator_config.h"

namespace tern {

/// Reads the sensors into a configuration. `sensors` replaces `sensor`. @throws ConfigError
void read_sensors(ConfigSection& section, SimulatorConfig& config, std::uint64_t seed);

}  // namespace tern
