#include "launcher/app/flight.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/files.h"
#include "launcher/app/flight_folder.h"
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

template <class... T>
void warn(fmt::format_string<T...> format, T&&... values) {
  fmt::print(stderr, "tern-launch: {}\n", fmt::format(format, std::forward<T>(values)...));
}

std::string without_end(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string last_line(const std::string& text) {
  const std::string lines = without_end(text);
  return lines.substr(lines.rfind('\n') + 1);
}

/// The last line of a process's log, or the one before it says that it exits.
std::string last_words(const std::string& log) {
  const std::string::size_type exits = log.rfind(" exits with code ");
  const std::string::size_type end = exits == std::string::npos ? exits : log.rfind('\n', exits);
  return last_line(end == std::string::npos ? log : log.substr(0, end));
}

/// The number that an override gives a key, if there is one.
std::optional<std::int64_t> overridden(const LaunchOptions& options, const std::string& key) {
  std::optional<std::int64_t> number;
  for (const std::string& value : options.overrides) {
    const std::string digits = value.starts_with(key + "=") ? value.substr(key.size() + 1) : "";
    if (digits.empty() || digits.size() > 18 || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    number = std::stoll(digits);
  }
  return number;
}

void write_failure(const LaunchOptions& options, const std::string& reason, const fs::path& file) {
  FlightSummary summary;
  summary.detail = reason;
  summary.scenario = fs::path(options.scenario).stem();
  summary.seed = overridden(options, "seed");
  summary.count = overridden(options, "world.count");
  summary.command = options.command;
  summary.version = build_id();
  if (!write_text(file, to_json(summary))) warn("{}: the summary cannot be written", file.string());
}

/// Checks before the flight that the summary can be written after it. @throws std::runtime_error
void check_summary_file(const fs::path& file) {
  std::error_code error;
  if (file.empty()) return;
  const bool was_there = fs::exists(file, error);
  if (!std::ofstream(file, std::ios::app)) throw std::runtime_error(file.string() + ": the summary cannot be written");
  if (!was_there) fs::remove(file, error);
}

/// Reports once why the flight has failed, on stderr and to the monitor.
int give_up(const fs::path& record, const std::string& why) {
  const fs::path file = record / "failure", fresh = record / "failure.new";
  std::error_code error;
  if (fs::exists(file, error)) return kExitFailed;
  warn("{}", why);
  if (write_text(fresh, why + '\n')) fs::rename(fresh, file, error);  // the file is complete as soon as it exists
  return kExitFailed;
}

/// @return by process, an open file with its keys; empty if messages are unsigned
std::map<std::string, int> make_keys(const LaunchOptions& options) {
  std::map<std::string, int> fds;
  if (!options.key) return fds;
  const Key master = options.key->empty() ? random_key() : value_or_throw(read_master_key(*options.key));
  for (const ProcessRole& entry : process_roles()) {
    fds.emplace(entry.process, value_or_throw(seal_in_memory(KeyRing::derive(master, entry.process))));
  }
  return fds;
}

void announce(const LaunchOptions& options, const fs::path& record, const std::vector<SupervisedProcess>& processes) {
  std::ofstream(record / "env.sh") << fmt::format("export LCM_DEFAULT_URL='{}' TERN_PACE={}\n", options.lcm_url,
                                                  options.pace);
  std::ofstream commands(record / "command");
  commands << options.command << '\n';
  for (const SupervisedProcess& process : processes) commands << shell_line(process.child.command) << '\n';
  std::ofstream flown(record / "scenario.yaml");
  flown << "# As flown: " << options.scenario << '\n';
  for (const std::string& value : options.overrides) flown << "# " << shell_line({"--set", value}) << '\n';
  flown << read_text(options.scenario);
  say("Flight of {}\n  record   {}", options.scenario, record.string());
  if (options.namespace_flags.empty()) {
    say("  network  export LCM_DEFAULT_URL='{}'", options.lcm_url);
  } else {
    std::ofstream(record / "namespace") << getpid() << ' ' << options.namespace_flags << '\n';
    say("  network  its own namespace; a shell in it: launch_scripts/enter.sh {}", record.string());
  }
  if (options.pace != 1.0) say("  pace     {} s of flight per second", options.pace);
  if (options.view_fd) say("  view     {}", options.view_url);
  for (const std::string& value : options.autopilot_limits) say("  limits   {}, within the autopilot's bounds", value);
  if (options.key) say("  key      messages are signed");
}

/// Evaluates an event. @return the flight's exit code, or nullopt if the flight continues
std::optional<int> verdict(const fs::path& record, const SupervisorEvent& event) {
  if (event.process.empty()) return event.code;
  const bool is_monitor = event.process == kMonitor, has_summary = fs::exists(record / "summary.json");
  if (is_monitor ? !has_summary && event.code != kExitIncomplete : event.code != 0) {
    const std::string words = last_words(read_text(record / (event.process + ".log")));
    give_up(record, fmt::format("{} ended with exit code {}: {}", event.process, event.code, words));
    std::error_code error;
    if (!fs::exists(record / "failure", error)) return kExitFailed;  // the monitor cannot learn of it
  }
  return is_monitor ? std::optional(code_after_flight(event.code, has_summary)) : std::nullopt;
}

/// @return the flight's exit code, with the logger's end
int code_after_logger(int code, const ProcessEnd& logger) {
  if (shell_code(logger) == 0) return code;
  warn("{} ended with {}: the recording may lack its last messages", kLogger, to_text(logger));
  return code == 0 ? kExitIncomplete : code;
}

/// Longest wait for the logger, s. After it the flight begins anyway.
constexpr int kLoggerStartS = 5;

struct Wait {
  bool done = false;
  int signal = 0;  ///< signal that arrived meanwhile, or 0
};

/// Waits until a byte can be read, for at most this many seconds.
Wait await_byte(int fd, int seconds, const sigset_t& signals) {
  constexpr int kLookMs = 100;
  for (int ms = 0; ms < 1000 * seconds; ms += kLookMs) {
    pollfd word{fd, POLLIN, 0};
    if (poll(&word, 1, kLookMs) > 0) return {.done = true};
    const timespec at_once{};
    const int signal = sigtimedwait(&signals, nullptr, &at_once);
    if (signal > 0 && signal != SIGCHLD) return {.signal = signal};
  }
  return {};
}

/// Waits until tern-viewer reports that a page has connected, for at most options.view_wait_s.
/// @return a signal that arrived meanwhile, or 0
int await_page(const LaunchOptions& options, int looked, const sigset_t& signals) {
  if (options.view_wait_s == 0) return 0;
  say("  the flight begins when a page has connected, at the latest in {} s (--view-wait)", options.view_wait_s);
  const Wait wait = await_byte(looked, options.view_wait_s, signals);
  if (!wait.done && wait.signal == 0) say("  no page has connected: the flight begins without one");
  return wait.signal;
}

/// Runs checks_of_unused_sections. @throws std::runtime_error with the refusal of one
void run_checks(const std::vector<std::vector<std::string>>& checks, const fs::path& record) {
  const fs::path log = record / "check.log";
  for (const std::vector<std::string>& command : checks) {
    const int out = open_log(log);
    const ProcessEnd end = await_child(start_child({.command = command, .out = out, .error = out}));
    close(out);
    if (shell_code(end) != 0) throw std::runtime_error(last_line(read_text(log)));
    fs::remove(log);
  }
}

int supervise(LaunchOptions options, const fs::path& record, const sigset_t& signals) try {
  ConfigDocument document = ConfigDocument::load(options.scenario, options.overrides);
  const Scenario scenario =
      read_scenario(document);  // so that a bad scenario is refused once instead of by each process
  if (options.pace != 1.0 && !options.autopilot.empty() && !options.autopilot_sim) {
    throw std::runtime_error("--pace: a real autopilot's clock cannot be slowed; use --pace 1");
  }
  if (!options.autopilot.empty()) {
    const bool has_defaults = options.autopilot_sim && !document.root().section("autopilot_sim").flag("tuned", false);
    options.autopilot_limits = autopilot_limits(scenario.uav.limits, has_defaults);
    std::erase_if(options.autopilot_limits, [&](const std::string& value) {  // the user's own value wins
      const std::string key = value.substr(0, value.find('=') + 1);
      return std::ranges::any_of(options.overrides, [&](const std::string& own) { return own.starts_with(key); });
    });
  }
  const std::vector<std::string> sections = document.root().keys();
  options.detects = std::ranges::find(sections, "detector") != sections.end();
  options.estimates = document.root().section("simulator").text("estimation", "perfect") == "vio";
  int looked[2] = {-1, -1};
  if (options.view_fd && pipe2(looked, O_CLOEXEC) == 0) options.looked_fd = looked[1];
  int listens[2] = {-1, -1};
  if (pipe2(listens, O_CLOEXEC) == 0) options.listens_fd = listens[1];
  auto processes = flight_processes(options, record, make_keys(options));
  run_checks(checks_of_unused_sections(options, processes, sections), record);
  announce(options, record, processes);
  Supervisor supervisor(signals);
  for (SupervisedProcess& process : processes) {
    process.child.error = open_log(record / (process.name + ".log"));
    if (process.name != kMonitor) process.child.out = process.child.error;
    supervisor.start(process);
    int signal = 0;
    if (process.name == kViewer) signal = await_page(options, looked[0], signals);
    if (process.name == kLogger) signal = await_byte(listens[0], kLoggerStartS, signals).signal;
    if (signal != 0) {
      supervisor.end_first(kMavlink, options.pace);
      supervisor.stop(kLogger);
      return kExitSignalled + signal;
    }
  }
  std::optional<int> code;
  while (!code) code = verdict(record, supervisor.wait());
  supervisor.end_first(kMavlink, options.pace);
  return code_after_logger(*code, supervisor.stop(kLogger));
} catch (const std::exception& e) {
  return give_up(record, e.what());
}

int watch_over(const LaunchOptions& options, const fs::path& record) {
  const sigset_t signals = block_signals();
  const pid_t self = getpid(), child = fork();
  if (child < 0) return give_up(record, "no process can be made");
  if (child == 0) {
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int code = getppid() == self ? supervise(options, record, signals) : kExitFailed;
    std::fflush(nullptr);
    _exit(code);
  }
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != child) {
    const int number = sigwaitinfo(&signals, nullptr);
    if (number > 0 && number != SIGCHLD) kill(child, number);
  }
  kill(-child, SIGKILL);  // the group's id is reserved until the child has been waited for
  const ProcessEnd end = await_child(child);
  return end.signal == 0 ? end.exit_code : give_up(record, fmt::format("tern-launch ended with {}", to_text(end)));
}

struct Awaited {
  ProcessEnd end;
  int signal = 0;  ///< the signal by which the user ended it, or 0
};

/// Waits for a child. A signal to tern-launch ends the child.
Awaited await_or_end(pid_t child) {
  const sigset_t signals = block_signals();
  while (true) {
    if (const auto end = poll_child(child)) return {*end, 0};
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal <= 0 || signal == SIGCHLD) continue;
    kill(child, SIGTERM);
    return {await_child(child), signal};
  }
}

/// Prints which steps of a mission were reached.
void report_mission(const LaunchOptions& options, const fs::path& record) {
  if (!options.mission.empty() && fs::exists(record / "mission.txt")) {
    say("\n{}", without_end(read_text(record / "mission.txt")));
  }
}

/// Runs audit and report, if requested. @return the flight's exit code after them
int after_flight(const LaunchOptions& options, const fs::path& record, int code) {
  int ended_by = 0;
  const bool has_failed = code == kExitFailed;  // then its reason is more important than the audit
  const auto run = [&](std::vector<std::string> command, int out) {
    command.front() = options.programs + "/" + command.front();
    const auto [end, signal] =
        await_or_end(start_child({.command = std::move(command), .out = out, .own_group = true}));
    ended_by = signal;
    return shell_code(end);
  };
  const std::string log = record / "flight.lcm", audit = record / "audit.txt";
  if (options.audit) {
    const int audit_code = run({"tern-audit", log, "--json", record / "audit.json"}, open_log(audit));
    if (ended_by != 0) return kExitSignalled + ended_by;
    code = code_after_audit(code, audit_code);
    say("\n{}", has_failed ? "Audit: " + audit : without_end(read_text(audit)));
  }
  if (options.report && run({"tern-report", log, "-o", record / "report.html"}, STDOUT_FILENO) != 0) {
    if (ended_by != 0) return kExitSignalled + ended_by;
    return code == kExitIncomplete ? code : kExitFailed;
  }
  return code;
}

/// Starts a viewer that plays the flight's log on the same socket. @return its process
pid_t play_again(const LaunchOptions& options, const fs::path& record) {
  const int log = open_log(record / "tern-viewer.log");
  return start_child(
      {.command = {options.programs + "/" + kViewer, "--log", record / "flight.lcm", "--page", options.page},
       .out = log,
       .error = log,
       .inherited = {*options.view_fd},
       .own_group = true});
}

/// Waits until the user ends the viewer, or it ends itself.
void keep_playing(pid_t player, const std::string& url) {
  say("\nThe page plays the flight again, until Ctrl-C: {}", url);
  (void)await_or_end(player);
}

/// Writes the summary of a flight that failed, and copies the summary to where it is requested.
/// @return the flight's exit code, with the copy's fate
int summarize(const LaunchOptions& options, const fs::path& record, int code) {
  const fs::path summary = record / "summary.json";
  std::error_code error;
  if (code == kExitFailed && !fs::exists(summary, error)) {
    const std::string why = last_line(read_text(record / "failure"));
    const std::string reason = why.empty() ? record.string() + ": the reason could not be written" : why;
    write_failure(options, reason, summary);
    summarize_failure(options, reason);
    return code;
  }
  if (options.summary.empty() || !fs::exists(summary, error)) return code;
  fs::copy_file(summary, options.summary, fs::copy_options::overwrite_existing, error);
  if (!error) return code;
  warn("{}: the summary cannot be written: {}", options.summary, error.message());
  return code == 0 ? kExitIncomplete : code;
}

}  // namespace

// A flight that never began leaves a folder only if --record names it.
int fly(const LaunchOptions& options) {
  check_summary_file(options.summary);
  const auto record = make_flight_folder(options);
  if (!record) {
    summarize_failure(options, record.error().message);
    throw std::runtime_error(record.error().message);
  }
  int code = watch_over(options, *record);
  std::error_code error;
  fs::remove(*record / "namespace", error);
  const bool is_played = options.view_fd && code < kExitSignalled && fs::exists(*record / "flight.lcm");
  const pid_t player = is_played ? play_again(options, *record) : 0;
  report_mission(options, *record);
  const bool is_over = code < kExitSignalled || (options.allow_goals && code > kExitSignalled);
  if (is_over && fs::exists(*record / "flight.lcm")) code = after_flight(options, *record, code);
  if (code > kExitSignalled) say("\nEnded by a signal; the record is in {}", record->string());
  code = summarize(options, *record, code);
  if (code == kExitFailed && options.record.empty() && !fs::exists(*record / "command")) fs::remove_all(*record, error);
  if (is_played) {
    keep_playing(player, options.view_url);
    say("See it again: launch_scripts/view.sh --log {}/flight.lcm", record->string());
  }
  return code;
}

void summarize_failure(const LaunchOptions& options, const std::string& reason) {
  if (!options.summary.empty()) write_failure(options, reason, options.summary);
}

}  // namespace tern
