// A receiver's memory of senders, of bounded size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

namespace tern {

/// Keeps a value of type Known for each of the kMaxSenders most recent senders. A new sender replaces the one that was
/// silent longest, so forged senders cannot fill the memory.
template <class Name, class Known>
class RecentSenders {
 public:
  /// Far more than the number of senders that restart while a message is on its way.
  static constexpr std::size_t kMaxSenders = 64;

  /// Returns the value of a sender that has just sent; a new Known if the sender is not remembered.
  /// @param forget  called with the value that is dropped for a new sender
  template <class Forget = void (*)(const Known&)>
  Known& touch(
      const Name& name, Forget&& forget = [](const Known&) {}) {
    Entry& entry = senders_[name];
    entry.last = ++count_;
    if (senders_.size() > kMaxSenders) {
      const auto longest_ago = [](const auto& a, const auto& b) { return a.second.last < b.second.last; };
      const auto forgotten = std::min_element(senders_.begin(), senders_.end(), longest_ago);
      forget(forgotten->second.known);
      senders_.erase(forgotten);
    }
    return entry.known;
  }

  /// Calls visit(known) for each sender.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [name, entry] : senders_) visit(entry.known);
  }

 private:
  struct Entry {
    Known known;
    std::int64_t last = 0;  ///< count_ at the sender's last message
  };
  std::map<Name, Entry> senders_;
  std::int64_t count_ = 0;
};

}  // namespace tern
