#include "monitor/process_table.h"

#include <numeric>

namespace tern {
namespace {

/// Starts of one process that are remembered; a forged heartbeat shall not fill the memory.
constexpr std::size_t kMaxStarts = 10'000;
constexpr std::size_t kMaxProcesses = 256;

}  // namespace

void ProcessTable::add(const Heartbeat& heartbeat, UTime now) {
  if (!processes_.contains(heartbeat.process) && processes_.size() >= kMaxProcesses) return;
  Process& process = processes_[heartbeat.process];
  process.heard = now;
  if (process.starts.size() < kMaxStarts) process.starts[heartbeat.header.name.sender_epoch_us] = heartbeat;
}

std::optional<UTime> ProcessTable::heard(const std::string& process) const {
  const auto found = processes_.find(process);
  return found == processes_.end() ? std::nullopt : std::optional(found->second.heard);
}

std::optional<std::int64_t> ProcessTable::epoch_us(const std::string& process) const {
  const auto found = processes_.find(process);
  return found == processes_.end() ? std::nullopt : std::optional(found->second.starts.rbegin()->first);
}

std::int64_t ProcessTable::restarts() const {
  std::int64_t restarts = 0;
  for (const auto& [name, process] : processes_) restarts += static_cast<std::int64_t>(process.starts.size()) - 1;
  return restarts;
}

std::map<std::string, MessageCount> ProcessTable::messages() const {
  std::map<std::string, MessageCount> messages;
  for (const auto& [name, process] : processes_) {
    for (const auto& [epoch, heartbeat] : process.starts) {
      for (const auto& [channel, counters] : heartbeat.channels) {
        MessageCount& count = messages[channel];
        count.received += counters.received;
        count.rejected += std::accumulate(std::begin(counters.rejected), std::end(counters.rejected), std::int64_t{0});
        count.lost += counters.lost;
      }
    }
  }
  return messages;
}

std::string ProcessTable::waiting() const {
  std::string text;
  for (const auto& [name, process] : processes_) {
    const Heartbeat& newest = process.starts.rbegin()->second;
    if (newest.state == ProcessState::Ready || newest.state == ProcessState::Finished) continue;
    text += (text.empty() ? "" : "; ") + name + ": " + (newest.waiting_for.empty() ? "starting" : newest.waiting_for);
  }
  return text;
}

}  // namespace tern
