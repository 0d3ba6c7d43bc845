#include <memory>
#include <string>
#include <vector>

#include "campaign/app/commands.h"
#include "campaign/app/summary_output.h"
#include "campaign/records/flight_table.h"
#include "runtime/command_line.h"
#include "runtime/config.h"

namespace tern {
namespace {

struct Options {
  std::vector<std::string> parts;
  std::string out, summary;
};

int merge(const Options& options) {
  Flights all;
  for (const std::string& part : options.parts)
    value_or_throw(join(all, value_of_file(read_flights(part))), part + ": ");
  value_of_file(write_flights(options.out, all));
  return write_summary(options.out, options.summary, command_line());
}

}  // namespace

void add_merge(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand("merge", "Merge the flights of several shards into one file");
  command->add_option("parts", options->parts, "Files of flights")->required()->type_name("PART.csv ...");
  command->add_option("--out", options->out, "The merged file, sorted by seed")->required()->type_name("FLIGHTS.csv");
  command->add_option("--summary", options->summary, "Summary of the campaign")->type_name("FILE.json");
  command->callback([&chosen, options] { chosen = [options] { return merge(*options); }; });
}

}  // namespace tern
