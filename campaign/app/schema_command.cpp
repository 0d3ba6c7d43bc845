#include <fmt/format.h>

#include <cstdio>

#include "campaign/app/commands.h"
#include "campaign/recorded_flight.h"
#include "campaign/scenario_schema.h"
#include "runtime/command_line.h"

namespace tern {

void add_schema(CommandLine& app, Command& chosen) {
  CommandLine command = app.add_subcommand("schema", "Print the JSON schema of scenario files");
  command->callback([&chosen] {
    chosen = [] {
      fmt::print("{}", scenario_schema());
      return std::fflush(stdout) == 0 ? 0 : kExitCannotWrite;
    };
  });
}

}  // namespace tern
