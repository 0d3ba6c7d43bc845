// Bounds the number of tracks, and so the work of a flood of false detections.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// The most tracks of detections without ids, and of those with ids. By chance, a false detection confirms the track of
/// another one, so a flood of them would make ever more tracks. A track takes some 15 µs of CPU time per observation
/// set and as much per prediction. At 30 and 20 Hz, 900 tracks take some 0.7 of a core.
inline constexpr std::size_t kMaxAnonymousTracks = 900, kMaxNamedTracks = 2400;

/// Returns the squared distance of a track's box, at its last detection, from a point, m².
inline double squared_distance(const TrackedObject& object, const Vec3& p) {
  const Box box =
      object.is_sighted ? object.faces.completed(object.position) : box_around(object.position, object.half_extents);
  return box.squaredExteriorDistance(p);
}

/// Deletes the tracks of ids in [first_id, end_id) whose boxes are farthest from the vehicle, so that at most `most`
/// are left. Ties are resolved by id.
/// @param objects  ascending by id
/// @return the number of deleted tracks that were detected at `at`
inline std::int32_t bound_tracks(std::vector<TrackedObject>& objects, std::int64_t first_id, std::int64_t end_id,
                                 std::size_t most, const Vec3& vehicle, UTime at) {
  const auto begin = std::ranges::lower_bound(objects, first_id, {}, &TrackedObject::id);
  const auto end = std::ranges::lower_bound(objects, end_id, {}, &TrackedObject::id);
  const auto count = static_cast<std::size_t>(end - begin);
  if (count <= most) return 0;
  std::vector<std::pair<double, std::int64_t>> by_distance;
  for (auto object = begin; object != end; ++object) {
    by_distance.emplace_back(squared_distance(*object, vehicle), object->id);
  }
  std::vector<std::pair<double, std::int64_t>> sorted = by_distance;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(most));
  const auto limit = sorted[most];
  std::int32_t detected = 0;
  const auto first = static_cast<std::size_t>(begin - objects.begin());
  std::size_t k = 0, kept = first;
  for (std::size_t o = first; o < objects.size(); ++o, ++k) {
    if (k < count && by_distance[k] >= limit) {
      detected += objects[o].last_seen == at ? 1 : 0;
    } else {
      if (kept != o) objects[kept] = std::move(objects[o]);
      ++kept;
    }
  }
  objects.resize(kept);
  return detected;
}

}  // namespace tern
