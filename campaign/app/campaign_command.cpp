#include <fcntl.h>
#include <fmt/format.h>
#include <sys/signalfd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <memory>
#include <system_error>
#include <thread>

#include "campaign/app/commands.h"
#include "campaign/app/flight_options.h"
#include "campaign/app/progress_output.h"
#include "campaign/app/summary_output.h"
#include "campaign/campaign.h"
#include "campaign/recorded_flight.h"
#include "runtime/command_line.h"
#include "runtime/config.h"

namespace tern {
namespace {

constexpr int kExitInterrupted = 130;
constexpr std::uint64_t kMaxSeed = (std::uint64_t{1} << 63U) - 1;

struct Options {
  FlightOptions flight;
  std::string seeds = "1:10", shard = "1/1", out, summary, failures;
  int jobs = 0;
  std::int64_t cpu_limit_s = CampaignOptions{}.cpu_limit_s;
};

/// Parses two numbers and the separator between them.
template <class Number>
bool read_pair(const std::string& text, char between, Number& first, Number& second) {
  const char* end = text.data() + text.size();
  const auto a = std::from_chars(text.data(), end, first);
  if (a.ec != std::errc{} || a.ptr == end || *a.ptr != between) return false;
  const auto b = std::from_chars(a.ptr + 1, end, second);
  return b.ec == std::errc{} && b.ptr == end;
}

CampaignOptions campaign_of(const Options& options) {
  CampaignOptions campaign;
  campaign.inputs = inputs_of(options.flight);
  if (options.out.empty()) throw ConfigError("--out is required: the file for the flights");
  if (!read_pair(options.seeds, ':', campaign.first_seed, campaign.last_seed) ||
      campaign.first_seed > campaign.last_seed || campaign.last_seed > kMaxSeed) {
    throw ConfigError(fmt::format("--seeds {}: not A:B with 0 <= A <= B < 2^63", options.seeds));
  }
  Shard& shard = campaign.shard;
  if (!read_pair(options.shard, '/', shard.index, shard.count) || shard.index < 1 || shard.index > shard.count) {
    throw ConfigError(fmt::format("--shard {}: not I/N with 1 <= I <= N", options.shard));
  }
  campaign.jobs = options.jobs > 0 ? options.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  campaign.out = options.out;
  campaign.failures = options.failures.empty() ? default_failures(options.out) : options.failures;
  campaign.audit = options.flight.audit;
  campaign.cpu_limit_s = options.cpu_limit_s;
  return campaign;
}

/// Returns a descriptor to read SIGINT, SIGTERM and SIGHUP from; these signals no longer end the process.
int catch_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signalfd(-1, &signals, SFD_CLOEXEC);
}

int fly(const Options& options) {
  const CampaignOptions campaign = campaign_of(options);
  const std::int64_t audited_before = count_audited(campaign.out);
  ProgressOutput output;
  const int stop_fd = catch_signals();
  const auto end = run_campaign(campaign, flight_command(options.flight), stop_fd,
                                [&](const CampaignProgress& p) { output.show(p); });
  output.finish();
  if (!end) {
    fmt::print(stderr, "{}\n", end.error().message);
    return kExitCannotWrite;
  }
  if (*end == CampaignEnd::Interrupted) {
    fmt::print(stderr, "interrupted; run the same command again to continue\n");
    return kExitInterrupted;
  }
  const int code = write_summary(campaign.out, options.summary, command_line());
  if (!campaign.audit.empty() && code == 0) {
    fmt::print("    {} audited in this run, {} before it\n", count_audited(campaign.out) - audited_before,
               audited_before);
  }
  return code;
}

/// Refuses options before a subcommand, where they would have no effect.
void refuse_own_options(const CommandLine& app) {
  for (const std::string& option : app.given()) {
    CommandLine::refuse(option, fmt::format("is not an option of {}, or must follow it", app.chosen_subcommand()));
  }
}

}  // namespace

void add_campaign(CommandLine& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  add_flight_options(app, options->flight);
  app.add_option("--seeds", options->seeds, "First and last seed")->type_name("A:B")->capture_default_str();
  app.add_option("--shard", options->shard, "Fly only every N-th seed, beginning with the I-th")
      ->type_name("I/N")
      ->capture_default_str();
  app.add_option("--jobs", options->jobs, "Number of flights at a time (default: one per core)")
      ->type_name("K")
      ->range(1, 10'000);
  app.add_option("--out", options->out,
                 "File of results, a line per flight; seeds that it already holds are not flown again")
      ->type_name("FLIGHTS.csv");
  app.add_option("--summary", options->summary, "Summary of the campaign")->type_name("FILE.json");
  app.add_option("--failures", options->failures, "Folder for flights that failed (default FLIGHTS.csv.failures)")
      ->type_name("DIR");
  app.add_option("--cpu-limit", options->cpu_limit_s, "CPU time after which a flight counts as failed, s")
      ->type_name("S")
      ->range(1, 1'000'000)
      ->capture_default_str();
  app.require_subcommand(0, 1);
  app.final_callback([&app, &chosen, options] {
    if (!app.chosen_subcommand().empty()) {
      refuse_own_options(app);
      return;
    }
    chosen = [options] { return fly(*options); };
  });
}

}  // namespace tern
