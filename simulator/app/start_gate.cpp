#include "simulator/app/start_gate.h"

namespace tern {

void StartGate::hear(const Heartbeat& heartbeat, UTime now) {
  heard_[heartbeat.process] = {now, heartbeat.state, heartbeat.waiting_for};
}

std::string StartGate::missing(UTime now) const {
  std::string text;
  for (const std::string& name : needed_) {
    const auto found = heard_.find(name);
    std::string why;
    if (found == heard_.end()) {
      why = "not heard";
    } else if (now - found->second.at > kHeartbeatAge) {
      why = "no longer heard";
    } else if (found->second.state != ProcessState::Ready) {
      why = found->second.waiting_for.empty() ? "not ready" : "waits for " + found->second.waiting_for;
    }
    if (!why.empty()) text += (text.empty() ? "" : ", ") + name + " (" + why + ")";
  }
  return text;
}

}  // namespace tern
