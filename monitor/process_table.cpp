#include "monitor/process_table.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tern {
namespace {

/// Most starts of one process that are remembered: forged heartbeats must not fill the memory.
constexpr std::size_t kMaxStarts = 10'000;
constexpr std::size_t kMaxProcesses = 256;

}  // namespace

void ProcessTable::add(const Heartbeat& heartbeat, UTime now) {
  forget_noise(now);
  if (!processes_.contains(heartbeat.process) && processes_.size() >= kMaxProcesses) return;
  const std::int64_t epoch_us = heartbeat.header.name.sender_epoch_us;
  Process& process = processes_[heartbeat.process];
  if (!process.starts.contains(epoch_us) && process.starts.size() >= kMaxStarts) return;
  const auto [found, is_new] = process.starts.try_emplace(epoch_us);
  Start& start = found->second;
  if (is_new) start.first_heartbeat = now;
  start.newest = heartbeat;
  if (heartbeat.state == ProcessState::Ready) start.words = heartbeat.waiting_for;
  start.last_heartbeat = now;
  ++start.beats;
  const auto active = process.starts.find(process.active_epoch_us);
  const bool silent = active != process.starts.end() && now - active->second.last_heartbeat > kHeartbeatTimeout;
  if (active == process.starts.end() || (silent && start.beats > 1)) process.active_epoch_us = epoch_us;
  if (const int n = living(process, now); n > 1) {
    concurrent_[heartbeat.process] = std::max(concurrent_[heartbeat.process], n);
  }
}

void ProcessTable::forget_noise(UTime now) {
  for (auto& [name, process] : processes_) {
    std::erase_if(process.starts, [now](const auto& start) {
      return start.second.beats == 1 && now - start.second.last_heartbeat > kHeartbeatTimeout;
    });
  }
  std::erase_if(processes_, [](const auto& process) { return process.second.starts.empty(); });
}

/// Number of starts whose heartbeats arrived recently, since the youngest of them began.
int ProcessTable::living(const Process& process, UTime now) {
  std::vector<const Start*> recent;
  for (const auto& [epoch_us, start] : process.starts) {
    if (start.beats > 1 && now - start.last_heartbeat <= kHeartbeatTimeout) recent.push_back(&start);
  }
  UTime youngest = now - kHeartbeatTimeout;
  for (const Start* start : recent) youngest = std::max(youngest, start->first_heartbeat);
  return static_cast<int>(
      std::ranges::count_if(recent, [&](const Start* start) { return start->last_heartbeat >= youngest; }));
}

std::string ProcessTable::concurrent_now(UTime now) const {
  std::string text;
  for (const auto& [name, process] : processes_) {
    const int n = living(process, now);
    if (n > 1) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + name;
  }
  return text;
}

std::optional<UTime> ProcessTable::last_heartbeat(const std::string& process, std::int64_t epoch_us) const {
  const auto found = processes_.find(process);
  if (found == processes_.end()) return std::nullopt;
  const auto start = found->second.starts.find(epoch_us);
  return start == found->second.starts.end() ? std::nullopt : std::optional(start->second.last_heartbeat);
}

std::int64_t ProcessTable::epoch_us(const std::string& process) const {
  const auto found = processes_.find(process);
  return found == processes_.end() ? 0 : found->second.active_epoch_us;
}

/// Counts starts in the order of their beginnings: one that begins after the last heartbeat of the one before is a
/// restart.
std::int64_t ProcessTable::restarts_of(const Process& process) {
  std::vector<const Start*> starts;
  for (const auto& [epoch_us, start] : process.starts) starts.push_back(&start);
  std::ranges::stable_sort(starts,
                           [](const Start* a, const Start* b) { return a->first_heartbeat < b->first_heartbeat; });
  std::int64_t restarts = 0;
  const Start* last = starts.front();
  for (const Start* start : starts) {
    if (start->first_heartbeat <= last->last_heartbeat) continue;
    last = start;
    ++restarts;
  }
  return restarts;
}

std::int64_t ProcessTable::restarts() const {
  std::int64_t restarts = 0;
  for (const auto& [name, process] : processes_) restarts += restarts_of(process);
  return restarts;
}

std::map<std::string, MessageCount> ProcessTable::messages() const {
  std::map<std::string, MessageCount> messages;
  for (const auto& [name, process] : processes_) {
    for (const auto& [epoch, start] : process.starts) {
      for (const auto& [channel, counters] : start.newest.channels) {
        MessageCount& count = messages[channel];
        count.received += counters.received;
        count.rejected += std::accumulate(std::begin(counters.rejected), std::end(counters.rejected), std::int64_t{0});
        count.lost += counters.lost;
      }
    }
  }
  return messages;
}

std::map<std::string, std::string> ProcessTable::words() const {
  std::map<std::string, std::string> words;
  for (const auto& [name, process] : processes_) {
    const auto active = process.starts.find(process.active_epoch_us);
    if (active == process.starts.end()) continue;
    const Start& start = active->second;
    const bool is_ready = start.newest.state == ProcessState::Ready || start.newest.state == ProcessState::Finished;
    if (is_ready && !start.words.empty()) words[name] = start.words;
  }
  return words;
}

std::string ProcessTable::waiting() const {
  std::string text;
  for (const auto& [name, process] : processes_) {
    const auto active = process.starts.find(process.active_epoch_us);
    if (active == process.starts.end()) continue;
    const Heartbeat& newest = active->second.newest;
    if (newest.state == ProcessState::Ready || newest.state == ProcessState::Finished) continue;
    text += (text.empty() ? "" : "; ") + name + ": " + (newest.waiting_for.empty() ? "starting" : newest.waiting_for);
  }
  return text;
}

}  // namespace tern
