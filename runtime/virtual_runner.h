// Hosts many nodes in one process, on one memq:// network and in virtual time: tests and campaigns.
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

enum class RunEnd : std::uint8_t {
  Condition,  ///< the caller's condition is true
  Finished,   ///< a node has finished
  Time,       ///< the end time was reached, or no wakeup is left
};

struct RunResult {
  RunEnd end = RunEnd::Time;
  std::string process;  ///< name of the finished process
  int exit_code = 0;    ///< of the finished process
};

/// A network of nodes that share one clock. The clock advances only when no node has work left.
///
/// At each instant two steps alternate until there is no more to do:
///  1. All messages are delivered in the order of publishing.
///  2. The hosts that are due are stepped in the order of their start.
///
/// Then the clock jumps to the earliest wakeup (of a node, a report or a paced message). So messages take no time and
/// all arrive. Equal nodes with equal inputs produce equal messages: byte for byte and in the same order.
class VirtualRunner {
 public:
  /// @param start  > 0, so that it is a valid time in messages
  explicit VirtualRunner(UTime start = UTime{1'000'000});
  ~VirtualRunner();
  VirtualRunner(const VirtualRunner&) = delete;
  VirtualRunner& operator=(const VirtualRunner&) = delete;

  /// Starts a process: a bus, the node that `make` builds on it, and their host. The bus's epoch is the current time,
  /// made unique by counting up.
  /// @return the node, which lives until stop() or the runner's end.
  Node& start(std::string process, const std::function<std::unique_ptr<Node>(Bus&)>& make,
              const std::string& effective_yaml = "");
  /// From now on, started processes (and an observer that is made later) get the keys that `master` gives them by their
  /// names. Nullopt: no keys, as at first.
  void use_key(std::optional<Key> master) { master_ = std::move(master); }
  /// Kills a process as SIGKILL would: its node, unsent messages and subscriptions are gone.
  /// @pre not called from a handler or step()
  /// @throws std::invalid_argument if no process has this name.
  void stop(std::string_view process);

  /// Runs until `until` is true, a node has finished, or the time is `end`. `until` may be empty; it is evaluated once
  /// per instant, after all messages were delivered. run() can be called again to continue. A finished node is still
  /// hosted, and a later run() reports it again.
  /// @throws the exception of a handler or node; std::logic_error if nodes keep exchanging messages without time
  ///   passing.
  RunResult run(UTime end, const std::function<bool()>& until = {});

  [[nodiscard]] UTime now() const { return clock_.now(); }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  /// A bus without a node, for a test or recorder that subscribes and publishes between runs. It sends no heartbeat.
  Bus& observer();
  /// The network itself, for a test that sends raw bytes as an intruder might.
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
