#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "campaign/app/commands.h"
#include "campaign/campaign.h"
#include "campaign/experiments/comparison_figure.h"
#include "campaign/page/campaign_page.h"
#include "campaign/records/campaign_comparison.h"
#include "core/base/files.h"
#include "runtime/command_line.h"
#include "runtime/config.h"

namespace tern {
namespace {

const std::map<std::string, TableForm> kTables{
    {"text", TableForm::Text}, {"markdown", TableForm::Markdown}, {"latex", TableForm::Latex}};
constexpr int kExitEqualFlights = 2;

struct Options {
  std::string a, b;
  std::string form = "text";
};

int compare_files(const Options& options) {
  const CampaignComparison comparison =
      value_or_throw(compare(value_of_file(read_flights(options.a)), value_of_file(read_flights(options.b))),
                     options.a + " and " + options.b + ": ");
  if (options.form == "svg") {
    fmt::print("{}", draw_comparison(comparison));
  } else {
    fmt::print("{}", to_text(comparison, kTables.at(options.form)));
  }
  if (comparison.may_infer()) return 0;
  fmt::print(stderr, "{} and {}: some flights are equal, so intervals would be meaningless\n", options.a, options.b);
  return kExitEqualFlights;
}

struct PageOptions {
  std::string flights, out, failures;
};

int write_page(const PageOptions& options) {
  namespace fs = std::filesystem;
  const fs::path out = options.out.empty() ? options.flights + ".html" : options.out;
  const fs::path failures = options.failures.empty() ? default_failures(options.flights) : options.failures;
  const fs::path link = fs::absolute(failures).lexically_relative(fs::absolute(out).parent_path());
  const std::string page = campaign_page(value_of_file(read_flights(options.flights)), link.string());
  if (!write_text(out, page)) throw FileError(out.string() + ": cannot be written");
  fmt::print("{}\n", out.string());
  return 0;
}

int print_columns() {
  for (const ColumnNote& note : column_notes()) fmt::print("{:<32}{}\n", note.name, note.meaning);
  return 0;
}

}  // namespace

void add_compare(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CommandLine command = app.add_subcommand("compare",
                                           "Compare two campaigns of a scenario over the same seeds, B against A; "
                                           "exit code 2: some flights are equal, "
                                           "so nothing can be inferred");
  command->add_option("a", options->a, "Flights of campaign A")->required()->type_name("A.csv");
  command->add_option("b", options->b, "Flights of campaign B")->required()->type_name("B.csv");
  command->add_option("--form", options->form, "A table in this form, or a drawing (default text)")
      ->one_of({"text", "markdown", "latex", "svg"});
  command->callback([&chosen, options] { chosen = [options] { return compare_files(*options); }; });
  auto page = std::make_shared<PageOptions>();
  CommandLine html = app.add_subcommand(
      "page", "Write a campaign as one HTML page: distributions, and failed flights with their logs");
  html->add_option("flights", page->flights, "Flights of a campaign")->required()->type_name("FLIGHTS.csv");
  html->add_option("--out", page->out, "The page (default FLIGHTS.csv.html)")->type_name("FILE.html");
  html->add_option("--failures", page->failures, "Folder of the flights that failed (default FLIGHTS.csv.failures)")
      ->type_name("DIR");
  html->callback([&chosen, page] { chosen = [page] { return write_page(*page); }; });
  CommandLine columns = app.add_subcommand("columns", "Print the meaning of each column of FLIGHTS.csv");
  columns->callback([&chosen] { chosen = print_columns; });
}

}  // namespace tern
