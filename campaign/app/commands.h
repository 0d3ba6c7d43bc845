// The subcommands of tern-campaign. Each adds itself to the command line; main() runs the selected one.
#pragma once

#include <functional>

#include "runtime/command_line.h"

namespace tern {

/// Runs a subcommand. @return the exit code. @throws ConfigError for an error that the user must correct (exit code 2)
using Command = std::function<int()>;

/// Each function sets `chosen` if its subcommand is on the command line. add_campaign adds the program itself, which
/// has no subcommand.
void add_campaign(CommandLine& app, Command& chosen);
void add_check(CommandLine& app, Command& chosen);
void add_fly_one(CommandLine& app, Command& chosen);
void add_judge_contacts(CommandLine& app, Command& chosen);
void add_merge(CommandLine& app, Command& chosen);
void add_schema(CommandLine& app, Command& chosen);
void add_summarize(CommandLine& app, Command& chosen);
/// Adds compare, page and columns.
void add_compare(CommandLine& app, Command& chosen);
/// Adds paper-6.1 and paper-6.2.
void add_paper(CommandLine& app, Command& chosen);

}  // namespace tern
