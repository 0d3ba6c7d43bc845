// Collects the batches of a set; only complete sets are handed on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/header.h"

namespace tern {

/// Collects batches of T (with members `header` and `batch`) of one set at a time. A newer set of the same sender, or a
/// newer sender, replaces an unfinished one, which is counted in incomplete().
template <class T>
class BatchCollector {
 public:
  /// @return the batches of the set in index order when `message` completed it. Batches of a sender epoch or a set
  /// older than the newest seen are dropped, and so are those that contradict the set's count. Out-of-order arrival
  /// within a set is fine; a repeated batch changes nothing.
  std::optional<std::vector<T>> add(const T& message) {
    const std::pair key{message.header.name.sender_epoch_us, message.batch.set};
    if (key < key_ || (key == key_ && missing_ == 0)) return std::nullopt;
    if (key > key_) {
      if (missing_ > 0) ++incomplete_;
      key_ = key;
      parts_.assign(static_cast<std::size_t>(message.batch.count), std::nullopt);
      missing_ = message.batch.count;
    }
    const auto index = static_cast<std::size_t>(message.batch.index);
    const bool fits = message.batch.count == static_cast<std::int32_t>(parts_.size()) && index < parts_.size();
    if (!fits || parts_[index]) return std::nullopt;
    parts_[index] = message;
    if (--missing_ > 0) return std::nullopt;
    std::vector<T> set;
    for (auto& part : parts_) set.push_back(std::move(*part));
    return set;
  }

  [[nodiscard]] std::int64_t incomplete() const { return incomplete_; }

 private:
  std::pair<std::int64_t, std::int64_t> key_{0, 0};
  std::vector<std::optional<T>> parts_;
  int missing_ = 0;
  std::int64_t incomplete_ = 0;
};

}  // namespace tern
