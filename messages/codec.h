// Bytes ↔ values: one pair per message, pure. A message is accepted only when every check passes (docs/architecture.md,
// "Bad input").
#pragma once

#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "core/world/health.h"
#include "messages/channels.h"

namespace tern {

using Bytes = std::vector<std::uint8_t>;

/// The message's LCM encoding (fingerprint first).
/// @throws std::invalid_argument for a caller's bug: a count beyond its limit, more than kMaxMessageBytes.
template <class T>
Bytes encode(const T& value);

/// The value of exactly these bytes, or why they are refused. Checks fingerprint, then counts (at fixed offsets, within
/// limits), then the length that the counts ask for. Then: numbers finite and in range; enumerations known; times in
/// order; fields consistent. A trailer may follow (trailer.h); its tag is not checked here. Never throws, allocates no
/// more than the message's own size asks for.
template <class T>
tl::expected<T, Rejection> decode(std::span<const std::uint8_t> bytes);

/// What lcmtypes/ calls the message. Beside each: the rules between its fields for which decode refuses it.
template <class T>
inline constexpr const char* kLcmType = nullptr;

template <>
inline constexpr const char* kLcmType<UavState> = "uav_state_t";
/// Inconsistent: following though not armed; following with a reason why not, or not following without one.
template <>
inline constexpr const char* kLcmType<VehicleStatus> = "vehicle_status_t";
/// Inconsistent: two detections with one track id.
template <>
inline constexpr const char* kLcmType<ObservationSet> = "observation_set_t";
/// Pieces and α of all tracks travel as one flat array.
/// Inconsistent: the tracks' piece counts do not sum to the pieces; two tracks have one id; a static track moves or has
/// several pieces.
template <>
inline constexpr const char* kLcmType<TrackSet> = "track_set_t";
template <>
inline constexpr const char* kLcmType<TrackBounds> = "track_bounds_t";
/// Inconsistent: runs that end beyond the grid, a class that has no name, a first class name that is not empty.
template <>
inline constexpr const char* kLcmType<MapChunk> = "map_chunk_t";
template <>
inline constexpr const char* kLcmType<Goal> = "goal_t";
/// Time: t_s before the committed trajectory, a deadline later than t_s − kDeadlineLead. Inconsistent: a committed
/// trajectory that does not end at rest, a start that is not its state at t_s (to kJoinTolerance), an empty flight box.
template <>
inline constexpr const char* kLcmType<HorizonRequest> = "horizon_request_t";
/// Inconsistent: a certificate plane of an interval or part that the trajectory does not have, or whose normal is not
/// of length 1 (to 1e-6). Whether the trajectory is a good one is the executor's and the audit's to judge.
template <>
inline constexpr const char* kLcmType<Plan> = "plan_t";
template <>
inline constexpr const char* kLcmType<PlanTiming> = "plan_timing_t";
/// Inconsistent: a node whose parent does not come before it.
template <>
inline constexpr const char* kLcmType<SearchView> = "search_view_t";
/// Inconsistent: name lengths that do not sum to the names' bytes, channels or echoes that are not in ascending order.
template <>
inline constexpr const char* kLcmType<Heartbeat> = "heartbeat_t";
/// Inconsistent: a hash that is not digest(yaml).
template <>
inline constexpr const char* kLcmType<ConfigurationReport> = "configuration_t";
/// Inconsistent: two obstacles with one id.
template <>
inline constexpr const char* kLcmType<ObstacleTruth> = "obstacle_truth_t";
/// Inconsistent: name lengths that do not sum to the names' bytes. The seven measures may be NaN.
template <>
inline constexpr const char* kLcmType<FlightResult> = "flight_result_t";

}  // namespace tern
