// Filters repeated deliveries of a message.
#pragma once

#include <cstddef>
#include <set>

#include "core/wire/header.h"

namespace tern {

/// Remembers the names of the newest messages of one channel, because a network may deliver a message several times.
class DuplicateFilter {
 public:
  /// Number of remembered names. A repetition arrives within milliseconds, and a channel carries at most some hundred
  /// messages per second.
  static constexpr std::size_t kRemembered = 4096;

  /// True for the first message of this name. A message without a name ({0, 0}) always counts as the first.
  bool is_first(const MessageName& name) {
    if (name == MessageName{}) return true;
    if (!names_.insert(name).second) return false;
    if (names_.size() > kRemembered) names_.erase(names_.begin());
    return true;
  }

 private:
  std::set<MessageName> names_;
};

}  // namespace tern
