// Random valid messages, for property tests of whatever takes or carries them.
#pragma once

#include "core/base/random.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/health.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/search_view.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"

namespace tern::support {

enum class Fill {
  Mixed,    ///< counts anywhere in their range, small ones more often; numbers sometimes at the ends of their ranges
  Largest,  ///< every count at its published maximum (a TrackSet: as many tracks as may be, a piece each)
};

/// A value that decode() accepts, of any of the message types: UavState, VehicleStatus, ObservationSet, TrackSet,
/// MapChunk, Goal, HorizonRequest, Plan, PlanTiming, SearchView, TrackBounds, Heartbeat, ConfigurationReport,
/// ObstacleTruth, FlightResult.
template <class T>
T random_message(Rng& rng, Fill fill = Fill::Mixed);

/// A track of `pieces` pieces.
Track random_track(Rng& rng, std::int64_t id, int pieces);

}  // namespace tern::support
