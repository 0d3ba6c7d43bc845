#include "core/world/track_order.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tern {

void sort_by_reach(std::vector<Track>& tracks, const Vec3& vehicle, UTime now, Duration horizon) {
  using Key = std::tuple<double, double, std::int64_t, std::size_t>;
  std::vector<Key> keys;
  keys.reserve(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Track& track = tracks[i];
    keys.emplace_back(track.bounds(now, now + horizon).exteriorDistance(vehicle),
                      track.bounds(now, now).exteriorDistance(vehicle), track.id, i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Track> sorted;
  sorted.reserve(tracks.size());
  for (const Key& key : keys) sorted.push_back(std::move(tracks[std::get<3>(key)]));
  tracks = std::move(sorted);
}

}  // namespace tern
