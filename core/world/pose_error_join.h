// Pairs POSE_ERROR with the sets of PREDICTIONS.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "core/world/pose_error.h"
#include "core/world/track.h"

namespace tern {

/// Keeps the newest POSE_ERRORs, and adds them to their sets.
class PoseErrorJoin {
 public:
  void add(const PoseError& error) {
    const std::int64_t epoch_us = error.header.name.sender_epoch_us;
    first_.try_emplace(epoch_us, error.set);
    errors_.insert_or_assign({epoch_us, error.set}, error);
    if (errors_.size() > kMaxErrors) errors_.erase(errors_.begin());
    if (first_.size() > kMaxSenders) first_.erase(first_.begin());
  }

  /// Sets `set.pose_error`.
  /// @return false if it is missing: its sender began to send POSE_ERROR at this set or earlier. Without its margins
  /// such a set is not to be used
  [[nodiscard]] bool add_to(TrackSet& set) const {
    const std::int64_t epoch_us = set.header.name.sender_epoch_us;
    const auto first = first_.find(epoch_us);
    if (first == first_.end() || set.batch.set < first->second) return true;
    const auto error = errors_.find({epoch_us, set.batch.set});
    if (error == errors_.end()) return false;
    set.pose_error = error->second;
    return true;
  }

 private:
  static constexpr std::size_t kMaxErrors = 64, kMaxSenders = 8;

  std::map<std::int64_t, std::int64_t> first_;                         ///< by sender epoch: its first set with one
  std::map<std::pair<std::int64_t, std::int64_t>, PoseError> errors_;  ///< by sender epoch and set
};

}  // namespace tern
