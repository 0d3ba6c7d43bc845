// Runs a tool that works on recorded flights: parses its command line and sets its exit code.
#pragma once

#include <functional>
#include <string>

#include "runtime/command_line.h"

namespace tern {

/// Parses, then runs. A bad command line, and an exception of `run`, are printed on stderr as "NAME: reason".
/// @return the result of `run`; 0 after --help or --version; kExitBadConfiguration after an error, or if stdout could
/// not be written.
int run_tool(CommandLine& app, const std::string& name, int argc, char** argv, const std::function<int()>& run);

}  // namespace tern
