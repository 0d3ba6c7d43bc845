// What a listener remembers of each sender, in bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace tern {

/// A Known for each sender. Forged senders cost no memory: the one not heard longest is forgotten first.
template <class Name, class Known>
class RecentSenders {
 public:
  /// Many more than restart while a message is on its way.
  static constexpr std::size_t kMaxSenders = 64;

  /// What is known of a sender that was heard now; a new Known for one that is not remembered.
  /// @param forget  called with what is forgotten for it
  template <class Forget = void (*)(const Known&)>
  Known& touch(
      const Name& name, Forget&& forget = [](const Known&) {}) {
    Entry& entry = senders_[name];
    entry.heard = ++count_;
    if (senders_.size() > kMaxSenders) {
      const auto longest_ago = [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; };
      const auto forgotten = std::min_element(senders_.begin(), senders_.end(), longest_ago);
      forget(forgotten->second.known);
      senders_.erase(forgotten);
    }
    return entry.known;
  }

  /// Calls visit(known) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [name, entry] : senders_) visit(entry.known);
  }

 private:
  struct Entry {
    Known known;
    std::int64_t heard = 0;  ///< counts what was heard
  };
  std::map<Name, Entry> senders_;
  std::int64_t count_ = 0;
};

}  // namespace tern
