// Random valid messages for property tests.
#pragma once

#include "core/base/random.h"
#include "core/wire/health.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/scan.h"
#include "core/world/search_view.h"
#include "core/world/speed_limit.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"

namespace tern::support {

enum class Fill {
  Mixed,    ///< counts anywhere in their ranges, mostly small; numbers sometimes at the ends of their ranges
  Largest,  ///< every count at its maximum (a TrackSet: the largest number of tracks, with one piece each)
};

/// Returns a random value that decode() accepts. T is any of the message types (messages/channels.h).
template <class T>
T random_message(Rng& rng, Fill fill = Fill::Mixed);

/// Returns a random track with this number of pieces.
Track random_track(Rng& rng, std::int64_t id, int pieces);

}  // namespace tern::support
