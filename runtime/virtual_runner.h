// Hosts many nodes in one process, on one memq:// network, in virtual time: tests and campaigns.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/process.h"

namespace tern {

/// Why VirtualRunner::run returned.
enum class RunEnd : std::uint8_t {
  Condition,  ///< the caller's predicate held
  Finished,   ///< a node has finished
  Time,       ///< the end time was reached, or nothing will ever happen again
};

struct RunResult {
  RunEnd end = RunEnd::Time;
  std::string process;  ///< of the node that finished
  int exit_code = 0;    ///< of the node that finished
};

/// A network of nodes that share one clock which moves only when all of them have nothing to do.
///
/// At each instant, two steps alternate until nothing is left. Every message is delivered in the order of publishing;
/// the hosts that are due are stepped in the order of their start. Then the clock jumps to the earliest wakeup (of a
/// node, a report or a paced message). So a message takes no time, nothing is lost, and equal nodes with equal inputs
/// give equal messages, byte for byte and in order.
class VirtualRunner {
 public:
  /// @param start  µs, > 0 so that it is a valid time in messages
  explicit VirtualRunner(UTime start = UTime{1'000'000});
  ~VirtualRunner();
  VirtualRunner(const VirtualRunner&) = delete;
  VirtualRunner& operator=(const VirtualRunner&) = delete;

  /// Starts a process: a bus of its own, the node that `make` builds on it, their host. The bus's epoch is the time
  /// now, made unique by counting up.
  /// @return the node, which lives until stop() or the runner's end.
  Node& start(std::string process, const std::function<std::unique_ptr<Node>(Bus&)>& make,
              const std::string& effective_yaml = "");
  /// Processes that start from now on, and an observer not yet made, have the keys that `master` gives them by their
  /// names. With nullopt they have none, as at first.
  void use_key(std::optional<Key> master) { master_ = std::move(master); }
  /// Kills the process as SIGKILL would: node, unsent messages and subscriptions are gone. @pre not called from a
  /// handler or step().
  /// @throws std::invalid_argument when no process has this name.
  void stop(std::string_view process);

  /// Runs until `until` holds, a node has finished, or the time is `end`. `until` may be empty; it is asked once per
  /// instant, when all its messages are delivered. Can be called again to go on. A finished node is still hosted; a
  /// later run() reports it again.
  /// @throws what a handler or a node threw; std::logic_error when nodes keep each other busy without time passing.
  RunResult run(UTime end, const std::function<bool()>& until = {});

  [[nodiscard]] UTime now() const { return clock_.now(); }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  /// A bus without a node, for a test or a recorder that listens and talks between runs; it has no heartbeat.
  Bus& observer();
  /// The network itself, for a test that sends bytes of its own making, as somebody might who is none of the processes.
  [[nodiscard]] lcm::LCM& network() { return *lcm_; }

 private:
  struct Process;
  void settle();
  [[nodiscard]] UTime next_wakeup() const;
  std::int64_t next_epoch();
  [[nodiscard]] std::unique_ptr<Bus> make_bus(std::string_view process);

  VirtualClock clock_;
  std::shared_ptr<lcm::LCM> lcm_;
  std::vector<std::unique_ptr<Process>> processes_;
  std::unique_ptr<Bus> observer_;
  std::int64_t last_epoch_ = 0;
  std::optional<Key> master_;
};

}  // namespace tern
