// Tells the first delivery of a message from its repetitions.
#pragma once

#include <cstddef>
#include <set>

#include "core/world/header.h"

namespace tern {

/// Remembers the names of the newest messages of one channel. A network may deliver a message more than once; it is
/// counted once.
class DuplicateFilter {
 public:
  /// Names that are remembered; a repetition comes within milliseconds, a channel carries at most some hundred per
  /// second.
  static constexpr std::size_t kRemembered = 4096;

  /// True for the first message of that name. A message without a name ({0, 0}) is always the first.
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
