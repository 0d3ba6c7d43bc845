#include "campaign/campaign.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "campaign/recorded_flight.h"
#include "campaign/records/distinct_flights.h"
#include "campaign/workers/process_pool.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

constexpr int kReportEvery = 1'000;  // ms

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// Returns true if a signal from outside ended the process, which tells nothing about the flight.
bool was_ended(const FinishedProcess& finished) {
  return finished.signal == SIGINT || finished.signal == SIGTERM || finished.signal == SIGHUP;
}

/// One call of run_campaign().
class Run {
 public:
  Run(const CampaignOptions& options, const CampaignIdentity& identity, const std::vector<std::string>& flight_command,
      FlightTable& table)
      : options_(options), identity_(identity), command_(flight_command), table_(table) {
    for (const std::uint64_t seed : seeds_of(options)) {
      ++progress_.total;
      const auto known = table.flights().records.find(seed);
      if (known == table.flights().records.end()) {
        waiting_.push_back(seed);
      } else {
        count(known->second);
      }
    }
  }

  Result<CampaignEnd> fly_all(int stop_fd, const std::function<void(const CampaignProgress&)>& report) {
    for (std::size_t next = 0; next < waiting_.size() || pool_.running() > 0;) {
      while (next < waiting_.size() && pool_.running() < static_cast<std::size_t>(options_.jobs)) {
        start(waiting_[next++]);
      }
      report(progress_);
      bool stop = false;
      for (const FinishedProcess& finished : pool_.wait(stop_fd, kReportEvery, stop)) {
        if (was_ended(finished)) {
          fs::remove_all(flying(finished.key));
          stop = true;
          continue;
        }
        if (auto kept = keep(finished); !kept) {
          fs::remove_all(flying(finished.key));
          (void)interrupt();
          return tl::unexpected(kept.error());
        }
      }
      if (stop) return interrupt();
    }
    report(progress_);
    if (auto sorted = table_.close_sorted(); !sorted) return tl::unexpected(sorted.error());
    return CampaignEnd::Complete;
  }

 private:
  void count(const FlightRecord& record) {
    ++progress_.done;
    progress_.successes += is_success(record) ? 1 : 0;
    distinct_.add(record);
    progress_.different = distinct_.count();
  }

  /// Returns the folder of a flight's files until the flight is judged.
  [[nodiscard]] fs::path flying(std::uint64_t seed) const {
    return fs::path(options_.failures) / fmt::format(".flying-{}", seed);
  }

  void start(std::uint64_t seed) {
    fs::remove_all(flying(seed));  ///< from a campaign that was killed
    fs::create_directories(flying(seed));
    std::vector<std::string> command = command_;
    command.insert(command.end(), {"--seed", std::to_string(seed), "--folder", flying(seed).string()});
    pool_.start(seed, command, (flying(seed) / "flight.log").string(), options_.cpu_limit_s);
  }

  RecordedFlight read(const FinishedProcess& finished) const {
    std::string trouble;
    if (!finished.exit_code) {
      trouble = fmt::format("the flight's process died of signal {} ({})", finished.signal, strsignal(finished.signal));
    } else if (*finished.exit_code != 0) {
      trouble = fmt::format("the flight's process ended with exit code {}: {}", *finished.exit_code,
                            last_line(flying(finished.key) / "flight.log"));
    } else {
      const CsvRecords lines = parse_csv(finished.output);
      if (lines.records.size() == 2) {
        auto record = read_flight(lines.records[0]);
        auto times = read_times(lines.records[1]);
        if (record && times) return {std::move(*record), std::move(*times), {}};
      }
      trouble = "the flight's process gave no result";
    }
    RecordedFlight flight;
    flight.record.identity = identity_;
    flight.record.seed = flight.times.seed = finished.key;
    flight.record.result = unjudged(FlightOutcome::Failed, trouble);
    flight.times.machine = machine_name();
    flight.times.compiler = compiler_name();
    return flight;
  }

  Result<void> keep(const FinishedProcess& finished) {
    if (finished.exit_code == kExitCannotWrite) {
      return fail(fmt::format("seed {}: {}", finished.key, last_line(flying(finished.key) / "flight.log")));
    }
    RecordedFlight flight = read(finished);
    const fs::path from = flying(finished.key);
    if (is_success(flight.record)) {
      fs::remove_all(from);
    } else {
      const std::string name = fmt::format("seed-{}", finished.key);
      const fs::path to = fs::path(options_.failures) / name;
      fs::remove_all(to);
      fs::rename(from, to);
      if (fs::exists(to / "flight.lcm")) flight.record.log = name + "/flight.lcm";
    }
    count(flight.record);
    ++progress_.flown;
    return table_.add(flight.record, flight.times);
  }

  CampaignEnd interrupt() {
    const std::vector<std::uint64_t> dropped = pool_.keys();
    pool_.kill_all();
    for (const std::uint64_t seed : dropped) fs::remove_all(flying(seed));
    return CampaignEnd::Interrupted;
  }

  const CampaignOptions& options_;
  const CampaignIdentity& identity_;
  const std::vector<std::string>& command_;
  FlightTable& table_;
  std::vector<std::uint64_t> waiting_;
  CampaignProgress progress_;
  DistinctFlights distinct_;
  ProcessPool pool_;
};

}  // namespace

std::vector<std::uint64_t> seeds_of(const CampaignOptions& options) {
  std::vector<std::uint64_t> seeds;
  const auto step = static_cast<std::uint64_t>(options.shard.count);
  for (std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(options.shard.index - 1);
       seed <= options.last_seed; seed += step) {
    seeds.push_back(seed);
  }
  return seeds;
}

Result<CampaignEnd> run_campaign(const CampaignOptions& options, const std::vector<std::string>& flight_command,
                                 int stop_fd, const std::function<void(const CampaignProgress&)>& report) {
  const CampaignIdentity identity = check_inputs(options.inputs, options.first_seed);
  auto table = FlightTable::open(options.out, identity);
  if (!table) return tl::unexpected(table.error());
  try {
    Run run(options, identity, flight_command, *table);
    auto end = run.fly_all(stop_fd, report);
    std::error_code not_empty;
    fs::remove(options.failures, not_empty);
    return end;
  } catch (const fs::filesystem_error& error) {
    return fail(error.what());
  }
}

std::string encode_flight(const FlightRecord& record, const FlightTimes& times) {
  return csv_line(to_cells(record)) + csv_line(to_cells(times));
}

std::string default_failures(const std::string& out) { return out + ".failures"; }

}  // namespace tern
