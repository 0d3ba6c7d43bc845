#include "mavlink/sim/app/autopilot_sim_node.h"

#include <utility>

namespace tern::mavlink {
namespace {

constexpr Duration kPollPeriod{2'000};

}  // namespace

AutopilotSimNode::AutopilotSimNode(Bus& bus, std::unique_ptr<Link> link, const SimulatedAutopilotConfig& config,
                                   std::uint64_t seed)
    : link_(std::move(link)), autopilot_(config, seed, bus.clock().now()), next_(bus.clock().now()) {}

void AutopilotSimNode::step(UTime now) {
  if (now < next_) return;
  next_ = now + kPollPeriod;
  while (const auto portion = link_->receive(now)) {
    for (const Frame& frame : parser_.push(portion->bytes)) autopilot_.receive(frame, now);
    if (link_->datagrams()) parser_.drop_rest();
  }
  autopilot_.step(now);
  for (const Frame& frame : autopilot_.take_frames()) link_->send(to_bytes(frame));
}

}  // namespace tern::mavlink
