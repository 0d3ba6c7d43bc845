#include <memory>
#include <string>

#include "campaign/app/commands.h"
#include "campaign/app/summary_output.h"
#include "runtime/command_line.h"

namespace tern {
namespace {

struct Options {
  std::string flights, summary;
};

}  // namespace

void add_summarize(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand("summarize", "Print the summary of a file of flights");
  command->add_option("flights", options->flights, "Flights of a campaign")->required()->type_name("FLIGHTS.csv");
  command->add_option("--summary", options->summary, "Summary of the campaign")->type_name("FILE.json");
  command->callback([&chosen, options] {
    chosen = [options] { return write_summary(options->flights, options->summary, command_line()); };
  });
}

}  // namespace tern
