// tern-autopilot-sim: a simulated autopilot as a process.
#pragma once

#include <memory>

#include "mavlink/link/link.h"
#include "mavlink/sim/simulated_autopilot.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern::mavlink {

/// Runs a SimulatedAutopilot on a link. On the bus it publishes only HEARTBEAT and CONFIGURATION.
class AutopilotSimNode final : public Node {
 public:
  AutopilotSimNode(Bus& bus, std::unique_ptr<Link> link, const SimulatedAutopilotConfig& config, std::uint64_t seed);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }

 private:
  std::unique_ptr<Link> link_;
  Parser parser_;
  SimulatedAutopilot autopilot_;
  UTime next_;
};

}  // namespace tern::mavlink
