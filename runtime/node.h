// A node: the behaviour of a process as message handlers and deadlines. It runs alone on the wall clock, or with other
// nodes in virtual time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/wire/health.h"

namespace tern {

inline constexpr UTime kNever{std::numeric_limits<std::int64_t>::max()};

/// The state that a node reports on HEARTBEAT.
struct NodeHealth {
  ProcessState state = ProcessState::Starting;
  /// In words; may be empty. HEARTBEAT carries it as plain_text() of at most kMaxWaitingText bytes.
  std::string waiting_for;
};

/// The behaviour of one process. A node subscribes on its Bus in its constructor. Handlers and step() are called from
/// one thread and never re-entered.
class Node {
 public:
  virtual ~Node() = default;
  /// When step() should be called next; kNever if the node only reacts to messages.
  [[nodiscard]] virtual UTime next_wakeup() const = 0;
  /// Called when next_wakeup() has come, and after each batch of messages. `now` never goes back.
  virtual void step(UTime now) = 0;
  [[nodiscard]] virtual NodeHealth health() const = 0;
  /// Called for each signal that asks the process to end. @return whether it ends now; if not, the node goes on until
  /// finished() has a code
  [[nodiscard]] virtual bool end(UTime /*now*/) { return true; }
  /// Facts that no scenario states, such as drawn values: lines without line breaks of their own. CONFIGURATION carries
  /// them below the YAML, as comments. Asked once, when the node starts.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
  /// The exit code, once the node has finished its work.
  [[nodiscard]] virtual std::optional<int> finished() const { return std::nullopt; }
};

}  // namespace tern
