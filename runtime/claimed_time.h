// The earliest time at which a message can have been sent, by the times that it states. SenderWatch refuses a message
// for which this time lies in the future.
#pragma once

#include <algorithm>

#include "core/wire/health.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/inertial.h"
#include "core/world/map_file.h"
#include "core/world/observation.h"
#include "core/world/scan.h"
#include "core/world/sighting.h"
#include "core/world/speed_limit.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"

namespace tern {

/// Largest time from the making of a request to its start, t_s: the executor's own limit.
inline constexpr Duration kMaxLead{5'000'000};

/// Returns the later of the time of sending and the sender's start.
inline UTime claimed_time(const Header& header) { return std::max(header.utime, UTime{header.name.sender_epoch_us}); }

template <class T>
UTime claimed_time(const T& message) {
  return claimed_time(message.header);
}
inline UTime claimed_time(const TrackSet& m) { return std::max(claimed_time(m.header), m.made_at); }
inline UTime claimed_time(const ObservationSet& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const CloudScan& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const DepthImage& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const MapFile& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const SightingSet& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const ImuBatch& m) { return std::max(claimed_time(m.header), m.samples.back().at); }
inline UTime claimed_time(const FeatureFrame& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const PositionFix& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const Odometry& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const ObstacleTruth& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const UavState& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const VehicleStatus& m) { return std::max(claimed_time(m.header), m.at); }
inline UTime claimed_time(const HorizonRequest& m) { return std::max(claimed_time(m.header), m.t_s - kMaxLead); }
/// A goal's id counts from 1, or is the time at which the goal was set, so that later goals have larger ids.
inline UTime claimed_time(const Goal& m) { return std::max(claimed_time(m.header), UTime{m.id}); }
inline UTime claimed_time(const SpeedLimit& m) { return std::max(claimed_time(m.header), UTime{m.goal_id}); }
/// Heartbeats and configurations claim no time, so they are accepted whatever their clock shows. Clocks are compared by
/// heartbeats (ClockSkew), and a clock that is far ahead should be reported.
inline UTime claimed_time(const Heartbeat&) { return {}; }
inline UTime claimed_time(const ConfigurationReport&) { return {}; }

}  // namespace tern
