// The options that select what is flown: they are the same for a campaign and for a single flight.
#pragma once

#include <string>
#include <vector>

#include "campaign/flight_inputs.h"
#include "runtime/command_line.h"

namespace tern {

/// The values of these options.
struct FlightOptions {
  std::string world;
  std::string count;                  ///< "" if not given
  std::vector<std::string> settings;  ///< key=value
  std::string charge = "cpu";
  std::string audit, coverage;  ///< programs
  bool oracle = false;          ///< declare the motion of every obstacle; overrides the scenario
};

/// Adds --world, --count and --set, which define the world.
void add_world_options(CommandLine& app, FlightOptions& options);

/// Adds the world options, --charge, --audit, --coverage and --oracle.
void add_flight_options(CommandLine& app, FlightOptions& options);

/// @throws ConfigError if the world is unknown, or if a setting sets the seed or has no effect
FlightInputs inputs_of(const FlightOptions& options);

/// Returns the command of this program for one flight, without "--seed N --folder DIR".
std::vector<std::string> flight_command(const FlightOptions& options);

}  // namespace tern
