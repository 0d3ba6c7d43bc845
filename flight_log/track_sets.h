// Puts the batches of recorded track sets together.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/track.h"
#include "messages/batching.h"

namespace tern {

/// Not the receivers' BatchCollector, which forgets a set as soon as a newer one begins: whichever set a process had
/// shall be found.
class RecordedSets {
 public:
  /// @return the whole set when `batch` completed it.
  std::optional<TrackSet> add(const TrackSet& batch) {
    const std::pair key{batch.header.name.sender_epoch_us, batch.batch.set};
    auto& parts = unfinished_[key];
    parts.emplace(batch.batch.index, batch);
    if (static_cast<std::int32_t>(parts.size()) < batch.batch.count) {
      if (unfinished_.size() > kMaxUnfinished) {
        unfinished_.erase(unfinished_.begin());
        ++given_up_;
      }
      return std::nullopt;
    }
    std::vector<TrackSet> batches;
    for (auto& [index, part] : parts) batches.push_back(std::move(part));
    unfinished_.erase(key);
    std::int64_t& newest = newest_[key.first];
    if (newest < key.second) newest = key.second;
    return join_batches(std::move(batches));
  }

  /// Sets of which a batch is missing although a later set of that sender is whole.
  [[nodiscard]] std::int64_t incomplete() const {
    std::int64_t count = given_up_;
    for (const auto& [key, parts] : unfinished_) {
      const auto newest = newest_.find(key.first);
      if (newest != newest_.end() && key.second < newest->second) ++count;
    }
    return count;
  }

 private:
  /// Sets that never become complete are given up, the oldest first, when so many others are begun.
  static constexpr std::size_t kMaxUnfinished = 32;

  std::map<std::pair<std::int64_t, std::int64_t>, std::map<std::int32_t, TrackSet>> unfinished_;
  std::map<std::int64_t, std::int64_t> newest_;  ///< complete set, by sender
  std::int64_t given_up_ = 0;
};

}  // namespace tern
