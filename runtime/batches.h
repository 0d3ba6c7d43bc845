// Collects the batches of a set and hands on complete sets only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "core/wire/header.h"

namespace tern {

/// Collects batches of T (with members `header` and `batch`), separately for each sender. The bus decides which sender
/// is accepted (SenderWatch).
///
/// A newer set of a sender replaces its unfinished one, which is then counted in incomplete(). Sets are ordered by the
/// time of sending (header.utime, then the sequence number). A wrong set number therefore blocks no later set.
template <class T>
class BatchCollector {
 public:
  /// Number of senders whose sets are collected. The sender that has been silent longest is forgotten first.
  static constexpr std::size_t kMaxSenders = 4;

  /// @return the batches of the set in index order, if `message` completes it; else nullopt.
  ///
  /// Batches of one set may arrive in any order; a repeated batch changes nothing. A batch is dropped if it was sent
  /// before the current set began, or if its count contradicts that set's.
  std::optional<std::vector<T>> add(const T& message) {
    Unfinished& set = of(message.header.name.sender_epoch_us);
    const std::pair sent{message.header.utime, message.header.name.sequence};
    if (message.batch.set != set.number) {
      if (set.number != 0 && sent <= set.newest) return std::nullopt;
      if (set.missing > 0) ++incomplete_;
      set.number = message.batch.set;
      set.parts.assign(static_cast<std::size_t>(message.batch.count), std::nullopt);
      set.missing = message.batch.count;
    }
    const auto index = idx(message.batch.index);
    const bool fits = message.batch.count == static_cast<std::int32_t>(set.parts.size()) && index < set.parts.size();
    if (set.missing == 0 || !fits || set.parts[index]) return std::nullopt;
    set.newest = std::max(set.newest, sent);
    set.parts[index] = message;
    if (--set.missing > 0) return std::nullopt;
    std::vector<T> whole;
    for (auto& part : set.parts) whole.push_back(std::move(*part));
    return whole;
  }

  [[nodiscard]] std::int64_t incomplete() const { return incomplete_; }

 private:
  struct Unfinished {
    std::int64_t number = 0;                            ///< 0: none yet
    std::pair<UTime, std::int64_t> newest{UTime{}, 0};  ///< time and sequence number of the newest batch
    std::vector<std::optional<T>> parts;
    int missing = 0;
    std::int64_t last_used = 0;
  };

  Unfinished& of(std::int64_t epoch_us) {
    Unfinished& set = senders_[epoch_us];
    set.last_used = ++count_;
    if (senders_.size() > kMaxSenders) {
      const auto longest_ago = [](const auto& a, const auto& b) { return a.second.last_used < b.second.last_used; };
      senders_.erase(std::min_element(senders_.begin(), senders_.end(), longest_ago));
    }
    return set;
  }

  std::map<std::int64_t, Unfinished> senders_;  ///< by epoch
  std::int64_t count_ = 0, incomplete_ = 0;
};

}  // namespace tern
