// The command line of a flight.
#pragma once

#include "launcher/flight_processes.h"

namespace CLI {
class App;
}

namespace tern {

/// Lets a command take a flight's options; parsing sets them. @pre `options` outlives `app`
void declare_options(CLI::App& app, FlightOptions& options);

}  // namespace tern
