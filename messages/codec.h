// Conversion between bytes and values, a pair of functions per message. decode() accepts a message only if every check
// passes (docs/architecture.md, "Bad input").
#pragma once

#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "core/wire/health.h"
#include "messages/channels.h"

namespace tern {

using Bytes = std::vector<std::uint8_t>;

/// Returns the LCM encoding of a message.
/// @throws std::invalid_argument if a count is beyond its limit or the message is longer than kMaxMessageBytes
template <class T>
Bytes encode(const T& value);

/// Returns the value of a message, or the reason for its refusal. It never throws, and the message's size bounds its
/// memory. The checks are, in this order:
///
/// 1. the fingerprint;
/// 2. the counts, which lie at fixed offsets;
/// 3. the length that the counts require; one trailer may follow (trailer.h), whose tag is not checked here;
/// 4. numbers finite and in their ranges, enumerations known, times in order, fields consistent.
template <class T>
tl::expected<T, Rejection> decode(std::span<const std::uint8_t> bytes);

/// The name of the message's type in lcmtypes/. The comments below state the rules between its fields; decode()
/// refuses a message that breaks one.
template <class T>
inline constexpr const char* kLcmType = nullptr;

template <>
inline constexpr const char* kLcmType<UavState> = "uav_state_t";
/// Inconsistent: `following` is true while `armed` is false; `following` is true with a `why_not`, or false without
/// one.
template <>
inline constexpr const char* kLcmType<VehicleStatus> = "vehicle_status_t";
/// Inconsistent: two detections have the same track id.
template <>
inline constexpr const char* kLcmType<ObservationSet> = "observation_set_t";
/// Inconsistent: the length of the quaternion is not 1; the number of depths is not rows × columns. Also: the field of
/// view of a camera reaches to a right angle; a lower bound is above its upper one.
template <>
inline constexpr const char* kLcmType<SightingSet> = "sighting_set_t";
template <>
inline constexpr const char* kLcmType<CloudScan> = "point_cloud_t";
/// Inconsistent: the length of the quaternion is not 1; the number of depths is not a multiple of the width.
template <>
inline constexpr const char* kLcmType<DepthImage> = "depth_image_t";
/// Inconsistent: the tracks' piece counts do not sum to the number of pieces. Also: two tracks have the same id; a
/// static track moves or has several pieces.
template <>
inline constexpr const char* kLcmType<TrackSet> = "track_set_t";
template <>
inline constexpr const char* kLcmType<PoseError> = "pose_error_t";
template <>
inline constexpr const char* kLcmType<LandmarkDensities> = "landmark_densities_t";
template <>
inline constexpr const char* kLcmType<TrackBounds> = "track_bounds_t";
/// Inconsistent: runs end beyond the grid; a class has no name; the first class name has text.
template <>
inline constexpr const char* kLcmType<MapChunk> = "map_chunk_t";
/// Inconsistent: the part is not below the number of parts.
template <>
inline constexpr const char* kLcmType<MapFile> = "map_file_t";
template <>
inline constexpr const char* kLcmType<Goal> = "goal_t";
template <>
inline constexpr const char* kLcmType<SpeedLimit> = "speed_limit_t";
/// Inconsistent: the fences' corner counts do not sum to the number of corners; a polygon has a centre. A polygon may
/// cross itself: the mapper refuses it.
template <>
inline constexpr const char* kLcmType<FenceSet> = "fence_set_t";
/// Time: t_s precedes the committed trajectory; the deadline is later than t_s − kDeadlineLead. Inconsistent: the
/// committed trajectory does not end at rest; `start` differs from its state at t_s by more than kJoinTolerance; the
/// flight box is empty.
template <>
inline constexpr const char* kLcmType<HorizonRequest> = "horizon_request_t";
/// Inconsistent: a certificate plane names an interval or part beyond those of the trajectory. Also: the length of a
/// normal differs from 1 by more than 1e-6. The executor and the audit judge the trajectory itself.
template <>
inline constexpr const char* kLcmType<Plan> = "plan_t";
template <>
inline constexpr const char* kLcmType<PlanHeading> = "plan_heading_t";
template <>
inline constexpr const char* kLcmType<PlanTiming> = "plan_timing_t";
template <>
inline constexpr const char* kLcmType<PlanUnseen> = "plan_unseen_t";
/// Inconsistent: a node precedes its parent.
template <>
inline constexpr const char* kLcmType<SearchView> = "search_view_t";
/// Inconsistent: the name lengths do not sum to the names' bytes; channels or echoes are out of ascending order.
template <>
inline constexpr const char* kLcmType<Heartbeat> = "heartbeat_t";
/// Inconsistent: the hash differs from digest(yaml).
template <>
inline constexpr const char* kLcmType<ConfigurationReport> = "configuration_t";
/// Inconsistent: two obstacles have the same id.
template <>
inline constexpr const char* kLcmType<ObstacleTruth> = "obstacle_truth_t";
/// Time: the samples are not in ascending order.
template <>
inline constexpr const char* kLcmType<ImuBatch> = "imu_t";
/// Inconsistent: the quaternion has not the length 1; two features have the same id.
template <>
inline constexpr const char* kLcmType<FeatureFrame> = "feature_tracks_t";
template <>
inline constexpr const char* kLcmType<PositionFix> = "position_fix_t";
/// Inconsistent: the quaternion has not the length 1.
template <>
inline constexpr const char* kLcmType<Odometry> = "odometry_t";
/// Inconsistent: the name lengths do not sum to the names' bytes. The eight measures may be NaN.
template <>
inline constexpr const char* kLcmType<FlightResult> = "flight_result_t";

}  // namespace tern
