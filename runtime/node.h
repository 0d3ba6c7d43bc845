// A node: a process's life as values and deadlines, so that it runs alone on the wall clock or with all others in
// virtual time.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/world/health.h"

namespace tern {

inline constexpr UTime kNever{std::numeric_limits<std::int64_t>::max()};

/// What a node says of itself on HEARTBEAT.
struct NodeHealth {
  ProcessState state = ProcessState::Starting;
  std::string waiting_for;  ///< in words; empty when nothing
};

/// Subscribes on its Bus in its constructor; handlers and step() are called from one thread, never re-entered.
class Node {
 public:
  virtual ~Node() = default;
  /// When step() wants to be called next; kNever when only a message can change anything.
  [[nodiscard]] virtual UTime next_wakeup() const = 0;
  /// Called when next_wakeup() has come, and after each batch of messages. now never goes back.
  virtual void step(UTime now) = 0;
  [[nodiscard]] virtual NodeHealth health() const = 0;
  /// An exit code when the node has done its work.
  [[nodiscard]] virtual std::optional<int> finished() const { return std::nullopt; }
};

}  // namespace tern
