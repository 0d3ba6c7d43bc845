// The options that say what is flown, the same for a campaign and for one flight.
#pragma once

#include <string>
#include <vector>

#include "campaign/flight_inputs.h"

namespace CLI {
class App;
}

namespace tern {

struct FlightOptions {
  std::string world;
  std::string count;                  ///< "" when not given
  std::vector<std::string> settings;  ///< key=value
  std::string charge = "cpu";
  std::string audit, coverage;  ///< programs
  bool oracle = false;          ///< motions declared, whatever the scenario says
};

/// --world, --count, --set: what a world is made from.
void add_world_options(CLI::App& app, FlightOptions& options);

/// Those, --charge, --audit, --coverage and --oracle.
void add_flight_options(CLI::App& app, FlightOptions& options);

/// @throws ConfigError when there is no such world, or a setting sets the seed or has no effect.
FlightInputs inputs_of(const FlightOptions& options);

/// This program's command to fly one of them: "--seed N --folder DIR" is to be added.
std::vector<std::string> flight_command(const FlightOptions& options);

}  // namespace tern
