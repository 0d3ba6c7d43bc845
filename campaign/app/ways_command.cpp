#include <fmt/format.h>

#include <fstream>
#include <memory>

#include "campaign/app/commands.h"
#include "campaign/experiments/ways_experiment.h"

namespace tern {
namespace {

struct Options {
  WaysOptions ways;
  std::string out;
};

int run(const Options& options) {
  const std::vector<ChosenWay> ways = choose_ways(options.ways);
  if (!options.out.empty()) {
    std::ofstream file(options.out);
    file << to_csv(ways);
    if (!file.flush()) throw FileError(options.out + ": cannot be written");
  }
  fmt::print("{}", to_markdown(ways));
  return 0;
}

}  // namespace

void add_ways(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand(
      "ways",
      "Ways through drawn worlds of textures, some with wrong labels, chosen by several rules. Prints by how much each "
      "costs more than an oracle's that knows the true labels");
  command->add_option("--worlds", options->ways.worlds, "Number of worlds; five families in turn")
      ->range(1, 100'000)
      ->capture_default_str();
  command->add_option("--seed", options->ways.seed, "Seed of the first world")->capture_default_str();
  command->add_option("--price", options->ways.price, "Metres of way that a metre of the position's σ is worth")
      ->range(0.001, 1e4)
      ->capture_default_str();
  command->add_option("--wrong", options->ways.wrong_share, "Probability that the label of a region is wrong")
      ->range(0.0, 1.0)
      ->capture_default_str();
  command->add_option("--out", options->out, "Also write each way to this CSV file")->type_name("FILE");
  command->callback([&chosen, options] { chosen = [options] { return run(*options); }; });
}

}  // namespace tern
