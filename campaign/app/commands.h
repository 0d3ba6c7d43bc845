// The subcommands of tern-campaign. Each adds itself to the command line; main() runs the one that was chosen.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tern {

/// What the command line asks for. @return the exit code. @throws ConfigError for what the user must mend (exit 2).
using Command = std::function<int()>;

/// Each sets `chosen` when its words were on the command line. add_campaign is the program itself, without a
/// subcommand.
void add_campaign(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_fly_one(CLI::App& app, Command& chosen);
void add_judge_contacts(CLI::App& app, Command& chosen);
void add_merge(CLI::App& app, Command& chosen);
void add_schema(CLI::App& app, Command& chosen);
void add_summarize(CLI::App& app, Command& chosen);
/// compare, page and columns.
void add_compare(CLI::App& app, Command& chosen);
/// paper-6.1 and paper-6.2.
void add_paper(CLI::App& app, Command& chosen);

}  // namespace tern
