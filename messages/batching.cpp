#include "messages/batching.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/world/message_limits.h"
#include "messages/codec.h"
#include "messages/obstacle_truth.h"
#include "messages/track_set.h"

namespace tern {
namespace {

/// What a batch of T holds: its list, the flat items that an entry brings besides itself, and when the set was so.
template <class T>
struct Kind;

template <>
struct Kind<TrackSet> {
  static constexpr auto kEntries = &TrackSet::tracks;
  static constexpr auto kTime = &TrackSet::made_at;
  static constexpr std::size_t kMostEntries = kMaxTracksPerBatch;
  static constexpr std::size_t kMostItems = kMaxPiecesPerBatch;
  static std::size_t items(const Track& track) { return track.motion.pieces.size(); }
  static Track example(std::size_t pieces) {
    Track track;
    track.motion.pieces.resize(pieces);
    track.alpha.resize(pieces, Vec3::Zero());
    return track;
  }
};

template <>
struct Kind<ObstacleTruth> {
  static constexpr auto kEntries = &ObstacleTruth::obstacles;
  static constexpr auto kTime = &ObstacleTruth::at;
  static constexpr std::size_t kMostEntries = kMaxObstaclesPerBatch;
  static constexpr std::size_t kMostItems = 0;
  static std::size_t items(const TrueObstacle&) { return 0; }
  static TrueObstacle example(std::size_t) { return {}; }
};

template <class T>
std::size_t encoded_bytes(std::size_t entries, std::size_t items_each) {
  T set;
  (set.*Kind<T>::kEntries).assign(entries, Kind<T>::example(items_each));
  return encode(set).size();
}

/// How full a batch is. Sizes are measured on encoded examples, so that they follow the .lcm files.
template <class T>
class Room {
 public:
  template <class Entry>
  bool take(const Entry& entry) {
    const std::size_t items = Kind<T>::items(entry);
    const std::size_t bytes = bytes_ + per_entry() + items * per_item();
    if (entries_ + 1 > Kind<T>::kMostEntries || items_ + items > Kind<T>::kMostItems || bytes > kMaxMessageBytes)
      return false;
    ++entries_;
    items_ += items;
    bytes_ = bytes;
    return true;
  }

 private:
  static std::size_t empty() {
    static const std::size_t bytes = encoded_bytes<T>(0, 0);
    return bytes;
  }
  static std::size_t per_entry() {
    static const std::size_t bytes = encoded_bytes<T>(1, 0) - empty();
    return bytes;
  }
  static std::size_t per_item() {
    static const std::size_t bytes = encoded_bytes<T>(1, 1) - encoded_bytes<T>(1, 0);
    return bytes;
  }

  std::size_t entries_ = 0, items_ = 0, bytes_ = empty();
};

template <class T>
std::vector<T> split(const T& whole) {
  constexpr auto kEntries = Kind<T>::kEntries;
  T head = whole;
  (head.*kEntries).clear();
  std::vector<T> batches{head};
  Room<T> room;
  std::int32_t left_out = whole.left_out;
  bool full = false;
  for (const auto& entry : whole.*kEntries) {
    if (full || !Room<T>().take(entry)) {
      ++left_out;
      continue;
    }
    if (!room.take(entry)) {
      full = batches.size() == kMaxBatches;
      if (full) {
        ++left_out;
        continue;
      }
      batches.push_back(head);
      room = Room<T>();
      room.take(entry);
    }
    (batches.back().*kEntries).push_back(entry);
  }
  for (std::size_t i = 0; i < batches.size(); ++i) {
    batches[i].batch.index = static_cast<std::int32_t>(i);
    batches[i].batch.count = static_cast<std::int32_t>(batches.size());
    batches[i].left_out = left_out;
  }
  return batches;
}

template <class T>
T join(std::vector<T> batches) {
  constexpr auto kEntries = Kind<T>::kEntries;
  constexpr auto kTime = Kind<T>::kTime;
  if (batches.empty()) throw std::invalid_argument("a set of no batches");
  T whole = std::move(batches.front());
  whole.batch.index = 0;
  whole.batch.count = 1;
  for (auto batch = batches.begin() + 1; batch != batches.end(); ++batch) {
    auto& entries = (*batch).*kEntries;
    std::move(entries.begin(), entries.end(), std::back_inserter(whole.*kEntries));
    whole.*kTime = std::min(whole.*kTime, (*batch).*kTime);
    whole.left_out = std::max(whole.left_out, batch->left_out);
    if constexpr (requires { whole.confidence; }) whole.confidence = std::min(whole.confidence, batch->confidence);
  }
  std::stable_sort((whole.*kEntries).begin(), (whole.*kEntries).end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  return whole;
}

}  // namespace

std::vector<TrackSet> split_batches(const TrackSet& whole) { return split(whole); }
std::vector<ObstacleTruth> split_batches(const ObstacleTruth& whole) { return split(whole); }
TrackSet join_batches(std::vector<TrackSet> batches) { return join(std::move(batches)); }
ObstacleTruth join_batches(std::vector<ObstacleTruth> batches) { return join(std::move(batches)); }

}  // namespace tern
