// The newest time that a message claims has been: what nobody can know yet is refused (SenderWatch).
#pragma once

#include <algorithm>

#include "core/world/goal.h"
#include "core/world/health.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"

namespace tern {

/// A request is for at most this much later than it was made: the executor's own limit.
inline constexpr Duration kMaxLead{5'000'000};

/// When it was sent, and before that when its sender started.
inline UTime claimed_time(const Header& header) { return std::max(header.utime, UTime{header.name.sender_epoch_us}); }

template <class T>
UTime claimed_time(const T& message) {
  return claimed_time(message.header);
}
inline UTime claimed_time(const TrackSet& m) { return std::max(claimed_time(m.header), m.made_at); }
inline UTime claimed_time(const ObservationSet& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const ObstacleTruth& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const UavState& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const VehicleStatus& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const HorizonRequest& m) { return std::max(claimed_time(m.header), m.t_s - kMaxLead); }
/// An id counts from 1, or is the time when the goal was set: then a later one is always larger.
inline UTime claimed_time(const Goal& m) { return std::max(claimed_time(m.header), UTime{m.id}); }
/// Its time is there to be compared (ClockSkew), and says nothing of the world: a clock that is far ahead shall be
/// named, not unheard.
inline UTime claimed_time(const Heartbeat&) { return {}; }
inline UTime claimed_time(const ConfigurationReport&) { return {}; }

}  // namespace tern
