// Assembles recorded track sets from their batches.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/pose_error_join.h"
#include "core/world/track.h"
#include "messages/batching.h"

namespace tern {

/// Assembles track sets, also when batches of different sets are mixed. (The BatchCollector of the receivers drops a
/// set when a newer one begins; a reader of logs must find every set that some process received.)
class RecordedSets {
 public:
  /// Adds the POSE_ERROR of a set that is not complete yet.
  void add(const PoseError& error) { errors_.add(error); }

  /// Adds a batch. @return the complete set if this batch completes it and its POSE_ERROR is not missing
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
    TrackSet whole = join_batches(std::move(batches));
    if (errors_.add_to(whole)) return whole;
    ++given_up_;
    return std::nullopt;
  }

  /// Returns the number of incomplete sets whose sender has a later complete one.
  [[nodiscard]] std::int64_t incomplete() const {
    std::int64_t count = given_up_;
    for (const auto& [key, parts] : unfinished_) {
      const auto newest = newest_.find(key.first);
      if (newest != newest_.end() && key.second < newest->second) ++count;
    }
    return count;
  }

 private:
  /// If more sets than this are incomplete, the oldest one is dropped.
  static constexpr std::size_t kMaxUnfinished = 32;

  std::map<std::pair<std::int64_t, std::int64_t>, std::map<std::int32_t, TrackSet>> unfinished_;
  std::map<std::int64_t, std::int64_t> newest_;  ///< newest complete set, by sender
  std::int64_t given_up_ = 0;
  PoseErrorJoin errors_;
};

}  // namespace tern
