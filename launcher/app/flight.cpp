#include "launcher/app/flight.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "launcher/app/supervisor.h"
#include "launcher/rules.h"
#include "monitor/flight_summary.h"
#include "runtime/keys.h"
#include "runtime/scenario_file.h"
#include "runtime/version.h"

namespace tern {
namespace {

namespace fs = std::filesystem;

template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  fmt::print("{}\n", fmt::format(format, std::forward<T>(values)...));
  std::fflush(stdout);
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// The number that the overrides give a key, if they do.
std::optional<std::int64_t> overridden(const FlightOptions& options, const std::string& key) {
  std::optional<std::int64_t> number;
  for (const std::string& value : options.overrides) {
    const std::string digits = value.starts_with(key + "=") ? value.substr(key.size() + 1) : "";
    if (digits.empty() || digits.size() > 18 || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    number = std::stoll(digits);
  }
  return number;
}

void write_failure(const FlightOptions& options, const std::string& reason, const fs::path& file) {
  FlightSummary summary;
  summary.detail = reason;
  summary.scenario = fs::path(options.scenario).stem();
  summary.seed = overridden(options, "seed");
  summary.count = overridden(options, "world.count");
  summary.version = build_id();
  std::ofstream(file) << to_json(summary);
}

class Flight {
 public:
  explicit Flight(const FlightOptions& options) : options_(options) {}
  int fly();

 private:
  [[nodiscard]] Result<void> prepare();
  [[nodiscard]] Result<void> make_record(std::uint64_t seed);
  int watch_over();
  int supervise(const sigset_t& signals);
  [[nodiscard]] Result<std::map<std::string, int>> hold_keys() const;
  void announce(const std::vector<SupervisedProcess>& processes) const;
  /// What it means for the flight that a process is gone. @return the exit code, or nullopt if the monitor has the word
  std::optional<int> verdict(const ProcessGone& gone);
  int give_up(const std::string& why);
  [[nodiscard]] int look_back(int code) const;
  void sum_up(int code) const;

  const FlightOptions& options_;
  fs::path record_;     ///< empty until it is made
  std::string reason_;  ///< why the flight failed, unless RECORD/failure says it
};

int Flight::fly() {
  const auto ready = prepare();
  int code = ready ? watch_over() : give_up(ready.error().message);
  if (options_.view_fd && code < kExitSignalled) {
    say("  see it again: launch_scripts/view.sh --log {}/flight.lcm", record_.string());
  }
  if (code < kExitFailed && fs::exists(record_ / "flight.lcm")) code = look_back(code);
  if (code > kExitSignalled) say("\nEnded by a signal; what was recorded: {}", record_.string());
  sum_up(code);
  return code;
}

Result<void> Flight::prepare() {
  try {
    ConfigDocument document = ConfigDocument::load(options_.scenario, options_.overrides);
    return make_record(read_scenario(document).seed);
  } catch (const ConfigError& e) {
    const auto made = make_record(1);
    return made ? fail(e.what()) : made;
  }
}

Result<void> Flight::make_record(std::uint64_t seed) {
  fs::path folder = options_.record;
  if (folder.empty()) {
    const auto now = fmt::gmtime(std::time(nullptr));
    const std::string name = fs::path(options_.scenario).stem();
    folder = fs::path(options_.flights) / fmt::format("{:%Y%m%dT%H%M%SZ}-{}-{}", now, name, seed);
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail(fmt::format("{} cannot be made: {}", folder.string(), error.message()));
  if (fs::exists(folder / "command")) return fail(fmt::format("{} holds a flight already", folder.string()));
  record_ = fs::canonical(folder);
  for (const char* left : {"failure", "summary.json"}) fs::remove(record_ / left);  // of a flight that could not begin
  return {};
}

int Flight::watch_over() {
  const sigset_t signals = block_signals();
  const pid_t self = getpid(), child = fork();
  if (child < 0) return give_up("no process can be made");
  if (child == 0) {
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int code = getppid() == self ? supervise(signals) : kExitFailed;
    std::fflush(nullptr);
    _exit(code);
  }
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != child) {
    const int number = sigwaitinfo(&signals, nullptr);
    if (number > 0 && number != SIGCHLD) kill(child, number);
  }
  kill(-child, SIGKILL);  // the group's number is taken as long as the child has not been waited for
  const ProcessEnd end = await_child(child);
  return end.signal == 0 ? end.exit_code : give_up(fmt::format("tern-launch ended with {}", to_text(end)));
}

int Flight::supervise(const sigset_t& signals) try {
  const auto keys = hold_keys();
  if (!keys) return give_up(keys.error().message);
  auto processes = flight_processes(options_, record_, *keys);
  announce(processes);
  Supervisor supervisor(signals);
  for (SupervisedProcess& process : processes) {
    process.child.error = open_log(record_ / (process.name + ".log"));
    if (process.name != kMonitor) process.child.out = process.child.error;
    supervisor.start(process);
  }
  std::optional<int> code;
  while (!code) {
    const auto event = supervisor.wait();
    if (const auto* gone = std::get_if<ProcessGone>(&event)) code = verdict(*gone);
    if (const auto* signal = std::get_if<SignalCame>(&event)) code = kExitSignalled + signal->number;
  }
  supervisor.stop(kLogger);
  return *code;
} catch (const std::exception& e) {
  return give_up(e.what());
}

Result<std::map<std::string, int>> Flight::hold_keys() const {
  std::map<std::string, int> fds;
  if (!options_.key) return fds;
  const Result<Key> master = options_.key->empty() ? random_key() : read_master_key(*options_.key);
  if (!master) return tl::unexpected(master.error());
  for (const Part& part : parts()) {
    const auto fd = hold_in_memory(KeyRing::derive(*master, part.process));
    if (!fd) return tl::unexpected(fd.error());
    fds.emplace(part.process, *fd);
  }
  return fds;
}

void Flight::announce(const std::vector<SupervisedProcess>& processes) const {
  std::ofstream(record_ / "env.sh") << fmt::format("export LCM_DEFAULT_URL='{}'\n", options_.lcm_url);
  std::ofstream commands(record_ / "command");
  commands << options_.typed << '\n';
  for (const SupervisedProcess& process : processes) commands << shell_line(process.child.command) << '\n';
  say("Flight of {}\n  record   {}", options_.scenario, record_.string());
  if (options_.namespace_flags.empty()) {
    say("  network  export LCM_DEFAULT_URL='{}'", options_.lcm_url);
  } else {
    std::ofstream(record_ / "namespace") << getpid() << ' ' << options_.namespace_flags << '\n';
    say("  network  its own namespace; a shell in it: launch_scripts/enter.sh {}", record_.string());
  }
  if (options_.view_fd) say("  view     {}", options_.view_url);
  if (options_.key) say("  key      messages are signed");
}

std::optional<int> Flight::verdict(const ProcessGone& gone) {
  const bool is_judge = gone.name == kMonitor, has_summary = fs::exists(record_ / "summary.json");
  if (is_judge ? !has_summary : gone.code != 0) {
    const std::string words = last_line(text_of(record_ / (gone.name + ".log")));
    give_up(fmt::format("{} ended with exit code {}: {}", gone.name, gone.code, words));
  }
  return is_judge ? std::optional(judged(gone.code, has_summary)) : std::nullopt;
}

int Flight::give_up(const std::string& why) {
  const fs::path file = record_ / "failure", fresh = record_ / "failure.new";
  if (!record_.empty() && fs::exists(file)) return kExitFailed;
  fmt::print(stderr, "tern-launch: {}\n", why);
  reason_ = why;
  if (record_.empty()) return kExitFailed;
  std::ofstream(fresh) << why << '\n';
  fs::rename(fresh, file);  // the monitor reads it as soon as it is there
  return kExitFailed;
}

int Flight::look_back(int code) const {
  const std::string log = record_ / "flight.lcm";
  if (options_.audit) {
    ChildProcess audit{.command = {options_.programs + "/tern-audit", log, "--json", record_ / "audit.json"}};
    audit.out = open_log(record_ / "audit.txt");
    audit.own_group = true;
    code = audited(code, shell_code(await_child(start_child(audit))));
    say("\n{}", text_of(record_ / "audit.txt"));
  }
  if (options_.report) {
    ChildProcess report{.command = {options_.programs + "/tern-report", log, "-o", record_ / "report.html"}};
    report.own_group = true;
    if (shell_code(await_child(start_child(report))) != 0) code = kExitFailed;
  }
  return code;
}

void Flight::sum_up(int code) const {
  const fs::path own = record_ / "summary.json";
  if (!record_.empty() && fs::exists(own)) {
    if (!options_.summary.empty()) fs::copy_file(own, options_.summary, fs::copy_options::overwrite_existing);
  } else if (code == kExitFailed) {
    const std::string said = record_.empty() ? "" : last_line(text_of(record_ / "failure"));
    const std::string& reason = said.empty() ? reason_ : said;
    if (!record_.empty()) write_failure(options_, reason, own);
    if (!options_.summary.empty()) write_failure(options_, reason, options_.summary);
  }
}

}  // namespace

int fly(const FlightOptions& options) { return Flight(options).fly(); }

void summarize_failure(const FlightOptions& options, const std::string& reason) {
  if (!options.summary.empty()) write_failure(options, reason, options.summary);
}

}  // namespace tern
