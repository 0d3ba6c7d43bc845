#include "launcher/app/supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <utility>

namespace tern {
namespace {

/// Time to end after SIGTERM: for most processes, and for the logger, which may still have to write messages.
constexpr Duration kPatience{1'000'000}, kLastPatience{5'000'000};
/// Longest wait until the vehicle is disarmed: a pilot may fly it. It is reported after kReportAfter.
constexpr Duration kArmedPatience{600'000'000}, kReportAfter{2'000'000};
constexpr Duration kLongPause{3'600'000'000};
constexpr std::uint64_t kMemoryLimitKb = 4'000'000;

std::optional<std::uint64_t> memory_limit_bytes() {
  const char* const text = std::getenv("TERN_MEMORY_LIMIT_KB");
  const std::uint64_t kb = text == nullptr ? kMemoryLimitKb : std::strtoull(text, nullptr, 10);
  return kb == 0 ? std::nullopt : std::optional(kb * 1024);
}

/// Whether the command is tern-mavlink or its script.
bool lands_a_vehicle(const std::vector<std::string>& command) {
  return std::ranges::any_of(command, [](const std::string& word) {
    const std::string name = std::filesystem::path(word).filename();
    return name == "tern-mavlink" || name == "mavlink.sh";
  });
}

/// Whether a bridge has ended that had begun, and did not disarm the vehicle. A first start that ends with a permanent
/// mistake sent no message.
bool may_leave_it_armed(const ProcessEnd& end, int restarts) {
  return shell_code(end) != 0 && (restarts > 0 || !is_permanent(end));
}

/// The pace in TERN_PACE, which the command also uses.
double pace_of_environment() {
  const char* const text = std::getenv("TERN_PACE");
  const double pace = text == nullptr ? 1.0 : std::strtod(text, nullptr);
  return pace > 0.0 && pace <= 1.0 ? pace : 1.0;
}

/// @return the next of these signals, or 0 if none arrives in that time.
int next_signal(const sigset_t& signals, Duration wait) {
  const std::int64_t us = std::max<std::int64_t>(wait.us, 0);
  const timespec time{us / 1'000'000, us % 1'000'000 * 1000};
  return std::max(sigtimedwait(&signals, nullptr, &time), 0);
}

sigset_t set_of(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  return set;
}

}  // namespace

sigset_t block_signals() {
  std::signal(SIGCHLD, SIG_DFL);
  sigset_t signals = set_of(SIGCHLD);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&signals, number);
  }
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void Supervisor::start(SupervisedProcess process) {
  process.child.memory_limit_bytes = memory_limit_bytes();
  supervised_.emplace_back().process = std::move(process);
  run(supervised_.back());
}

void Supervisor::run(Supervised& entry) {
  entry.due.reset();
  entry.started = clock_.now();
  entry.pid = start_child(entry.process.child);
}

SupervisorEvent Supervisor::wait() {
  while (true) {
    Duration pause = kLongPause;
    for (Supervised& entry : supervised_) {
      if (const auto end = entry.pid ? poll_child(*entry.pid) : std::nullopt) {
        entry.pid.reset();
        entry.end = *end;
        if (!entry.process.restarted || is_permanent(*end)) return {entry.process.name, shell_code(*end)};
        plan_restart(entry, *end);
      }
      if (entry.due && *entry.due <= clock_.now()) run(entry);
      if (entry.due) pause = std::min(pause, *entry.due - clock_.now());
    }
    const int signal = next_signal(signals_, pause);
    if (signal != 0 && signal != SIGCHLD) return {"", kExitSignalled + signal};
  }
}

void Supervisor::plan_restart(Supervised& entry, const ProcessEnd& end) {
  const Duration delay = entry.backoff.next(clock_.now() - entry.started);
  entry.due = clock_.now() + delay;
  dprintf(entry.process.child.error, "tern-launch: %s ended with %s; restart %d in %d ms\n", entry.process.name.c_str(),
          to_text(end).c_str(), ++entry.restarts, static_cast<int>(delay.us / 1000));
}

void Supervisor::end_first(const std::string& name, double pace) {
  std::vector<Supervised*> named;
  for (Supervised& entry : supervised_) {
    if (entry.process.name == name) named.push_back(&entry);
  }
  if (!have_ended(named)) await_landing(named, name, pace);
  for (const Supervised* entry : named) {
    if (!may_leave_it_armed(entry->end, entry->restarts)) continue;
    fmt::print(stderr, "tern-launch: {} ended with {}: THE VEHICLE MAY STILL BE ARMED AND IN THE AIR; see its log\n",
               name, to_text(entry->end));
  }
}

void Supervisor::await_landing(const std::vector<Supervised*>& named, const std::string& name, double pace) {
  signal_all(named, SIGTERM);
  const UTime begun = clock_.now();
  UTime deadline = begun + Duration::from_seconds(kArmedPatience.seconds() / pace);
  bool is_reported = false;
  while (!have_ended(named) && clock_.now() < deadline) {
    const UTime until = is_reported ? deadline : std::min(deadline, begun + kReportAfter);
    const int signal = next_signal(signals_, until - clock_.now());
    if (!is_reported && clock_.now() >= begun + kReportAfter) {
      is_reported = true;
      fmt::print(
          stderr,
          "tern-launch: waits until the vehicle is disarmed, at most {:.0f} s; Ctrl-C ends {} at once and leaves "
          "the vehicle to its pilot or its failsafe\n",
          (deadline - begun).seconds(), name);
    } else if (is_reported && signal != 0 && signal != SIGCHLD) {
      signal_all(named, SIGTERM);
      deadline = std::min(deadline, clock_.now() + kPatience);
    }
  }
  end(named, kPatience);
}

ProcessEnd Supervisor::stop(const std::string& last) {
  std::vector<Supervised*> others, last_group;
  for (Supervised& entry : supervised_) (entry.process.name == last ? last_group : others).push_back(&entry);
  end(others, kPatience);
  end(last_group, kLastPatience);
  return last_group.empty() ? ProcessEnd{} : last_group.back()->end;
}

bool Supervisor::have_ended(const std::vector<Supervised*>& group) {
  bool all = true;
  for (Supervised* entry : group) {
    entry->due.reset();
    const auto end = entry->pid ? poll_child(*entry->pid) : std::nullopt;
    if (end) {
      entry->end = *end;
      entry->pid.reset();
    }
    all = all && !entry->pid;
  }
  return all;
}

void Supervisor::signal_all(const std::vector<Supervised*>& group, int signal) {
  for (const Supervised* entry : group) {
    if (entry->pid) kill(*entry->pid, signal);
  }
}

void Supervisor::end(const std::vector<Supervised*>& group, Duration patience) {
  const UTime deadline = clock_.now() + patience;
  if (have_ended(group)) return;
  signal_all(group, SIGTERM);
  while (!have_ended(group) && clock_.now() < deadline) next_signal(set_of(SIGCHLD), deadline - clock_.now());
  for (Supervised* entry : group) {
    if (!entry->pid) continue;
    fmt::print(stderr, "tern-launch: {} did not end in time and is killed\n", entry->process.name);
    kill(*entry->pid, SIGKILL);
    entry->end = await_child(*entry->pid);
    entry->pid.reset();
  }
}

int keep_alive(const std::vector<std::string>& command, const std::string& log) {
  const sigset_t signals = block_signals();
  ChildProcess child{.command = command};
  if (!log.empty()) child.out = child.error = open_log(log);
  Supervisor supervisor(signals);
  const std::string name = std::filesystem::path(command.front()).filename();
  supervisor.start({name, child});
  const SupervisorEvent event = supervisor.wait();
  if (lands_a_vehicle(command)) supervisor.end_first(name, pace_of_environment());
  supervisor.stop("");
  return event.process.empty() ? 0 : event.code;
}

}  // namespace tern
