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

/// What lcmtypes/ calls the message.
template <class T>
inline constexpr const char* kLcmType = nullptr;
template <>
inline constexpr const char* kLcmType<UavState> = "uav_state_t";
template <>
inline constexpr const char* kLcmType<VehicleStatus> = "vehicle_status_t";
template <>
inline constexpr const char* kLcmType<ObservationSet> = "observation_set_t";
template <>
inline constexpr const char* kLcmType<TrackSet> = "track_set_t";
template <>
inline constexpr const char* kLcmType<MapChunk> = "map_chunk_t";
template <>
inline constexpr const char* kLcmType<Goal> = "goal_t";
template <>
inline constexpr const char* kLcmType<HorizonRequest> = "horizon_request_t";
template <>
inline constexpr const char* kLcmType<Plan> = "plan_t";
template <>
inline constexpr const char* kLcmType<PlanTiming> = "plan_timing_t";
template <>
inline constexpr const char* kLcmType<SearchView> = "search_view_t";
template <>
inline constexpr const char* kLcmType<Heartbeat> = "heartbeat_t";
template <>
inline constexpr const char* kLcmType<ConfigurationReport> = "configuration_t";
template <>
inline constexpr const char* kLcmType<ObstacleTruth> = "obstacle_truth_t";
template <>
inline constexpr const char* kLcmType<FlightResult> = "flight_result_t";

template <>
Bytes encode(const UavState& value);
template <>
tl::expected<UavState, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const VehicleStatus& value);
/// Inconsistent: following though not armed; following with a reason why not, or not following without one.
template <>
tl::expected<VehicleStatus, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const ObservationSet& value);
/// Inconsistent: two detections with one track id.
template <>
tl::expected<ObservationSet, Rejection> decode(std::span<const std::uint8_t> bytes);

/// Pieces and α of all tracks travel as one flat array.
template <>
Bytes encode(const TrackSet& value);
/// Inconsistent: the tracks' piece counts do not sum to the pieces; two tracks have one id; a static track moves or has
/// several pieces.
template <>
tl::expected<TrackSet, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const MapChunk& value);
/// Inconsistent: runs that end beyond the grid, a class that has no name, a first class name that is not empty.
template <>
tl::expected<MapChunk, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const Goal& value);
template <>
tl::expected<Goal, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const HorizonRequest& value);
/// Time: t_s before the committed trajectory, a deadline later than t_s − kDeadlineLead. Inconsistent: a committed
/// trajectory that does not end at rest, a start that is not its state at t_s (to kJoinTolerance), an empty flight box.
template <>
tl::expected<HorizonRequest, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const Plan& value);
/// Inconsistent: a certificate plane of an interval or part that the trajectory does not have, or whose normal is not
/// of length 1 (to 1e-6). Whether the trajectory is a good one is the executor's and the audit's to judge.
template <>
tl::expected<Plan, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const PlanTiming& value);
template <>
tl::expected<PlanTiming, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const SearchView& value);
/// Inconsistent: a node whose parent does not come before it.
template <>
tl::expected<SearchView, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const Heartbeat& value);
/// Inconsistent: name lengths that do not sum to the names' bytes, channels or echoes that are not in ascending order.
template <>
tl::expected<Heartbeat, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const ConfigurationReport& value);
/// Inconsistent: a hash that is not digest(yaml).
template <>
tl::expected<ConfigurationReport, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const ObstacleTruth& value);
/// Inconsistent: two obstacles with one id.
template <>
tl::expected<ObstacleTruth, Rejection> decode(std::span<const std::uint8_t> bytes);

template <>
Bytes encode(const FlightResult& value);
/// Inconsistent: name lengths that do not sum to the names' bytes. The seven measures may be NaN.
template <>
tl::expected<FlightResult, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
