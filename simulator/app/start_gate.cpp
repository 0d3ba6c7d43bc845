#include "simulator/app/start_gate.h"

#include <fmt/format.h>

#include <algorithm>

namespace tern {
namespace {

void append(std::string& list, const std::string& name, const std::string& why) {
  if (!why.empty()) list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", name, why);
}

double milliseconds(Duration d) { return static_cast<double>(d.us) * 1e-3; }

}  // namespace

void StartGate::receive(const Heartbeat& heartbeat, UTime received) {
  ProcessReport& report = reports_[heartbeat.process];
  const std::int64_t epoch_us = heartbeat.header.name.sender_epoch_us;
  if (report.epoch_us != epoch_us) report.skew = {};
  report.at = received;
  report.state = heartbeat.state;
  report.waiting_for = heartbeat.waiting_for;
  report.epoch_us = epoch_us;
  for (const ClockEcho& echo : heartbeat.echoes) {
    if (echo.sender_epoch_us == own_epoch_us_) report.skew.add(echo, heartbeat.header.utime, received);
  }
}

std::string StartGate::skew_of(const ProcessReport& report) const {
  const auto reading = report.skew.reading();
  if (!reading) return "";
  const bool behind = reading->ahead < Duration{};
  const Duration skew = behind ? reading->ahead * -1 : reading->ahead;
  if (skew * 2 - reading->round_trip <= max_skew_ * 2) return "";
  return fmt::format(
      "its clock is {:.1f} ms {} the vehicle's, more than {:g} ms and half a round trip of {:.1f} ms: synchronize the "
      "hosts' clocks",
      milliseconds(skew), behind ? "behind" : "ahead of", milliseconds(max_skew_), milliseconds(reading->round_trip));
}

bool StartGate::records(UTime now) const {
  if (std::find(needed_.begin(), needed_.end(), kRecorder) == needed_.end()) return true;
  const auto found = reports_.find(kRecorder);
  return found != reports_.end() && found->second.state == ProcessState::Ready &&
         now - found->second.at <= kHeartbeatAge;
}

std::string StartGate::missing(UTime now) const {
  std::string text;
  for (const std::string& name : needed_) {
    const auto found = reports_.find(name);
    if (found == reports_.end()) {
      append(text, name, "no HEARTBEAT");
    } else if (now - found->second.at > kHeartbeatAge) {
      append(text, name, "its HEARTBEAT has ceased");
    } else if (const std::string skew = skew_of(found->second); !skew.empty()) {
      append(text, name, skew);
    } else if (found->second.state == ProcessState::Failed && !found->second.waiting_for.empty()) {
      append(text, name, found->second.waiting_for);
    } else if (found->second.state != ProcessState::Ready) {
      append(text, name, found->second.waiting_for.empty() ? "not ready" : "waits: " + found->second.waiting_for);
    } else if (!found->second.skew.reading()) {
      append(text, name, "has not echoed a HEARTBEAT: its clock cannot be compared");
    }
  }
  return text;
}

std::string StartGate::skewed() const {
  std::string text;
  for (const std::string& name : needed_) {
    if (const auto found = reports_.find(name); found != reports_.end()) append(text, name, skew_of(found->second));
  }
  return text;
}

std::string StartGate::clocks() const {
  std::string text;
  for (const std::string& name : needed_) {
    const auto found = reports_.find(name);
    if (found == reports_.end()) continue;
    const auto reading = found->second.skew.reading();
    if (!reading) continue;
    text += fmt::format("{}{} {:+.1f} ms (round trip {:.1f} ms)", text.empty() ? "" : ", ", name,
                        milliseconds(reading->ahead), milliseconds(reading->round_trip));
  }
  return text;
}

}  // namespace tern
