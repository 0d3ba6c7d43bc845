#include "messages/batching.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/wire/message_limits.h"
#include "core/world/resampling.h"
#include "messages/codec.h"

namespace tern {
namespace {

/// The elements of flat arrays that belong to one entry.
struct Load {
  std::size_t items = 0;
  bool has_shares = false;  ///< each item has shares of α
  bool has_axes = false;    ///< they differ between the axes, so all shares of the message are those of an axis
};

/// The properties of a set of type T: its list, the load of an entry, and the set's time.
template <class T>
struct Kind;

template <>
struct Kind<TrackSet> {
  static constexpr auto kEntries = &TrackSet::tracks;
  static constexpr auto kTime = &TrackSet::made_at;
  static constexpr std::size_t kMaxEntries = kMaxTracksPerBatch;
  static constexpr std::size_t kMaxItems = kMaxPiecesPerBatch;
  static Load load(const Track& track) {
    return {track.motion.pieces.size(), track.kind == TrackKind::Estimated, !is_same_on_all_axes(track)};
  }
  static Track example(const Load& load) {
    Track track;
    track.kind = load.has_shares ? TrackKind::Estimated : TrackKind::Declared;
    track.motion.pieces.resize(load.items);
    track.alpha.resize(load.items, Vec3::Zero());
    if (load.has_shares) track.shares.resize(load.items, on_all_axes({1.0F, 1.0F, 1.0F, 1.0F}));
    return track;
  }
};

template <>
struct Kind<ObstacleTruth> {
  static constexpr auto kEntries = &ObstacleTruth::obstacles;
  static constexpr auto kTime = &ObstacleTruth::at;
  static constexpr std::size_t kMaxEntries = kMaxObstaclesPerBatch;
  static constexpr std::size_t kMaxItems = 0;
  static Load load(const TrueObstacle&) { return {}; }
  static TrueObstacle example(const Load&) { return {}; }
};

template <class T>
std::size_t encoded_bytes(std::size_t entries, const Load& each) {
  T set;
  (set.*Kind<T>::kEntries).assign(entries, Kind<T>::example(each));
  return encode(set).size();
}

/// The fill level of a batch. Sizes are measured on encoded examples, so they follow the .lcm files.
template <class T>
class Room {
 public:
  bool take(const Load& load) {
    Room with = *this;
    ++with.entries_;
    with.items_ += load.items;
    with.shares_ += load.has_shares ? load.items : 0;
    with.has_axes_ = has_axes_ || load.has_axes;
    const bool is_full = with.entries_ > Kind<T>::kMaxEntries || with.items_ > Kind<T>::kMaxItems;
    if (is_full || with.bytes() > kMaxMessageBytes) return false;
    *this = with;
    return true;
  }

 private:
  static std::size_t empty() {
    static const std::size_t bytes = encoded_bytes<T>(0, {});
    return bytes;
  }
  static std::size_t per_entry() {
    static const std::size_t bytes = encoded_bytes<T>(1, {}) - empty();
    return bytes;
  }
  static std::size_t per_item() {
    static const std::size_t bytes = encoded_bytes<T>(1, {1}) - encoded_bytes<T>(1, {});
    return bytes;
  }
  static std::size_t per_share() {
    static const std::size_t bytes = encoded_bytes<T>(1, {1, true}) - encoded_bytes<T>(1, {1});
    return bytes;
  }
  [[nodiscard]] std::size_t bytes() const {
    const std::size_t lists = has_axes_ ? 3 : 1;
    return empty() + entries_ * per_entry() + items_ * per_item() + lists * shares_ * per_share();
  }

  std::size_t entries_ = 0, items_ = 0, shares_ = 0;
  bool has_axes_ = false;
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
    const Load load = Kind<T>::load(entry);
    if (full || !Room<T>().take(load)) {
      ++left_out;
      continue;
    }
    if (!room.take(load)) {
      full = batches.size() == kMaxBatches;
      if (full) {
        ++left_out;
        continue;
      }
      batches.push_back(head);
      room = Room<T>();
      room.take(load);
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

/// True if tracks with these loads fit into a set, in this order.
bool all_fit(const std::vector<Load>& tracks) {
  Room<TrackSet> room;
  int batches = 1;
  for (const Load& track : tracks) {
    if (room.take(track)) continue;
    room = Room<TrackSet>();
    if (++batches > kMaxBatches || !room.take(track)) return false;
  }
  return true;
}

/// Returns the largest share in [0, kMaxPiecesPerBatch] for which loads_of(share) fit; 0 if none does.
template <class LoadsOf>
std::size_t largest_share(const LoadsOf& loads_of) {
  std::size_t fits = 0;
  std::size_t too_many = static_cast<std::size_t>(kMaxPiecesPerBatch) + 1;
  while (fits + 1 < too_many) {
    const std::size_t middle = (fits + too_many) / 2;
    (all_fit(loads_of(middle)) ? fits : too_many) = middle;
  }
  return fits;
}

std::vector<Load> loads_of(const TrackSet& set) {
  std::vector<Load> loads;
  loads.reserve(set.tracks.size());
  for (const Track& track : set.tracks) loads.push_back(Kind<TrackSet>::load(track));
  return loads;
}

/// Returns the loads limited to a share of pieces: twice the share in the first half, and at least one piece for each.
std::vector<Load> shared_out(std::vector<Load> loads, std::size_t share) {
  const auto most = static_cast<std::size_t>(kMaxPiecesPerBatch);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const std::size_t fair = 2 * k < loads.size() ? 2 * share : share;
    const std::size_t items = std::min(loads[k].items, std::clamp<std::size_t>(fair, 1, most));
    // Merged pieces have shares of their own on each axis.
    loads[k].has_axes = loads[k].has_axes || (loads[k].has_shares && items < loads[k].items);
    loads[k].items = items;
  }
  return loads;
}

/// True if the numbers that resampling can enlarge are within a message's ranges.
bool is_legal(const Track& track) {
  return std::ranges::all_of(track.alpha, [](const Vec3& alpha) { return alpha.maxCoeff() <= kMaxCoordinate; }) &&
         std::ranges::all_of(track.motion.pieces, [](const CubicPiece& piece) { return piece.duration <= kMaxSpan; });
}

/// Returns the set with its tracks resampled so that as many as possible fit.
TrackSet made_to_fit(const TrackSet& whole) {
  const std::vector<Load> own = loads_of(whole);
  const std::size_t share = largest_share([&](std::size_t s) { return shared_out(own, s); });
  const std::vector<Load> loads = shared_out(own, share);
  TrackSet set = whole;
  set.tracks.clear();
  for (std::size_t k = 0; k < loads.size(); ++k) {
    Track track = resampled(whole.tracks[k], loads[k].items);
    if (loads[k].items == own[k].items || is_legal(track)) {
      set.tracks.push_back(std::move(track));
    } else {
      ++set.left_out;
    }
  }
  return set;
}

template <class T>
T join(std::vector<T> batches) {
  constexpr auto kEntries = Kind<T>::kEntries;
  constexpr auto kTime = Kind<T>::kTime;
  if (batches.empty()) throw std::invalid_argument("join_batches: there is no batch");
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

bool is_same_on_all_axes(const Track& track) {
  return std::ranges::all_of(track.shares, [](const AlphaShares& shares) {
    return std::ranges::all_of(shares, [](const auto& of) { return of[0] == of[1] && of[1] == of[2]; });
  });
}

std::size_t pieces_for_each(std::size_t tracks, std::size_t single) {
  return largest_share([&](std::size_t share) {
    std::vector<Load> loads(tracks, Load{std::max<std::size_t>(share, 1)});
    loads.resize(tracks + single, Load{1});
    return loads;
  });
}

std::vector<TrackSet> split_batches(const TrackSet& whole) {
  return all_fit(loads_of(whole)) ? split(whole) : split(made_to_fit(whole));
}

std::vector<ObstacleTruth> split_batches(const ObstacleTruth& whole) { return split(whole); }
TrackSet join_batches(std::vector<TrackSet> batches) { return join(std::move(batches)); }
ObstacleTruth join_batches(std::vector<ObstacleTruth> batches) { return join(std::move(batches)); }

}  // namespace tern
