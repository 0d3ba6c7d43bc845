#include "runtime/virtual_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "runtime/lcm_network.h"

namespace tern {
namespace {

/// Most rounds of messages and steps at one instant. A chain of nodes that answer each other takes a handful.
constexpr int kMaxRounds = 1'000;
/// Most messages of one round, so that handlers which answer each other are stopped.
constexpr int kMaxMessagesPerRound = 10'000;

}  // namespace

struct VirtualRunner::Process {
  std::string name;
  std::unique_ptr<Bus> bus;  // outlives the node, whose handlers it calls
  std::unique_ptr<Node> node;
  std::unique_ptr<NodeHost> host;
};

VirtualRunner::VirtualRunner(UTime start) : clock_(start), lcm_(std::make_shared<lcm::LCM>("memq://")) {
  if (!lcm_->good()) throw std::runtime_error("LCM cannot open memq://");
}

VirtualRunner::~VirtualRunner() = default;

std::int64_t VirtualRunner::next_epoch() { return last_epoch_ = std::max(last_epoch_ + 1, clock_.now().us); }

std::unique_ptr<Bus> VirtualRunner::make_bus(std::string_view process) {
  std::optional<KeyRing> keys;
  if (master_) keys = KeyRing::derive(*master_, process);
  return std::make_unique<Bus>(lcm_, clock_, next_epoch(), "", std::move(keys));
}

Node& VirtualRunner::start(std::string process, const std::function<std::unique_ptr<Node>(Bus&)>& make,
                           const std::string& effective_yaml) {
  auto made = std::make_unique<Process>();
  made->name = std::move(process);
  made->bus = make_bus(made->name);
  made->node = make(*made->bus);
  made->host = std::make_unique<NodeHost>(*made->bus, *made->node, made->name, effective_yaml);
  processes_.push_back(std::move(made));
  return *processes_.back()->node;
}

void VirtualRunner::stop(std::string_view process) {
  const auto found = std::ranges::find_if(processes_, [&](const auto& p) { return p->name == process; });
  if (found == processes_.end()) throw std::invalid_argument(fmt::format("VirtualRunner: no process {}", process));
  processes_.erase(found);
}

Bus& VirtualRunner::observer() {
  if (!observer_) observer_ = make_bus("observer");
  return *observer_;
}

void VirtualRunner::settle() {
  for (int round = 0; round < kMaxRounds; ++round) {
    bool busy = drain(*lcm_, kMaxMessagesPerRound) > 0;
    if (observer_) observer_->rethrow();
    for (const auto& process : processes_) process->bus->rethrow();
    if (observer_ && observer_->next_due() <= now()) {
      observer_->send_due(now());
      busy = true;  // otherwise the batch would wait for the next instant
    }
    for (const auto& process : processes_) {
      if (!process->host->is_due(now())) continue;
      process->host->step(now());
      busy = true;
    }
    if (!busy) return;
  }
  std::string names;
  for (const auto& process : processes_) {
    if (process->host->is_due(now())) names += " " + process->name;
  }
  throw std::logic_error(fmt::format("VirtualRunner: no end of steps at {} us; still due:{}", now().us, names));
}

UTime VirtualRunner::next_wakeup() const {
  UTime next = observer_ ? observer_->next_due() : kNever;
  for (const auto& process : processes_) next = std::min(next, process->host->next_wakeup());
  return next;
}

RunResult VirtualRunner::run(UTime end, const std::function<bool()>& until) {
  while (true) {
    settle();
    for (const auto& process : processes_) {
      if (const auto code = process->node->finished()) return {RunEnd::Finished, process->name, *code};
    }
    if (until && until()) return {RunEnd::Condition, "", 0};
    const UTime next = next_wakeup();
    if (next > end) {
      clock_.advance_to(std::max(end, now()));
      return {};
    }
    clock_.advance_to(next);
  }
}

}  // namespace tern
