// The limits of message fields. lcmtypes/ states the same numbers. Senders keep them, and receivers refuse messages
// beyond them.
//
// Each limit is legal by itself; all together may exceed kMaxMessageBytes. The ranges of numbers are far beyond any
// vehicle. They keep sums, products and integer times of accepted values finite.
#pragma once

#include <cstdint>

#include "core/base/time.h"

namespace tern {

inline constexpr double kMaxCoordinate = 1e6;                      ///< |position| and extents per axis, m
inline constexpr double kMaxSpeed = 1e6;                           ///< |velocity| per axis, m/s
inline constexpr double kMaxAcceleration = 1e9;                    ///< |acceleration| per axis, m/s²
inline constexpr double kMaxJerk = 1e12;                           ///< |jerk| per axis, m/s³
inline constexpr double kMaxBodyExtent = 1e3;                      ///< radius and |vertex| per axis of a body, m
inline constexpr std::int64_t kMaxTimeUs = 4'000'000'000'000'000;  ///< |time|, µs: the year 2096
/// Ids of goals count from 1 or are times in µs. The next id after a legal one, and the mission's next number of 4096
/// ids, fit into 64 bits.
inline constexpr std::int64_t kMaxGoalId = kMaxTimeUs;
inline constexpr Duration kMaxSpan{1'000'000'000'000};  ///< of a track's piece or a hold: 11 days
inline constexpr Duration kMinIntervalDuration{1'000};  ///< smallest Δt of a trajectory
/// The largest Δt of a trajectory, for planner, messages and executor. A vehicle too slow to cross its sphere in J
/// intervals of this length plans to a nearer point.
inline constexpr Duration kMaxIntervalDuration{60'000'000};
/// The deadline of an answer lies at least this long before t_s, so that it can be received, checked and adopted.
inline constexpr Duration kDeadlineLead{5'000};

inline constexpr int kMaxDetections = 700;         ///< in an ObservationSet
inline constexpr int kMaxTracksPerBatch = 320;     ///< in a batch of a TrackSet
inline constexpr int kMaxPiecesPerBatch = 460;     ///< of all tracks of a batch together, so also of one track
inline constexpr int kMaxObstaclesPerBatch = 700;  ///< in a batch of an ObstacleTruth
inline constexpr int kMinControlPoints = 7;        ///< of a trajectory
inline constexpr int kMaxControlPoints = 64;       ///< of a trajectory
inline constexpr int kMaxBodyVertices = 64;
inline constexpr int kMaxCertificatePlanes = 1200;
inline constexpr int kMaxBudgetCuts = 256;
inline constexpr int kMaxMapClasses = 256;     ///< class names of a map, including the empty one
inline constexpr int kMaxMapClassText = 8192;  ///< bytes of all class names together
inline constexpr int kMaxHeartbeatChannels = 64;
inline constexpr int kMaxClockEchoes = 16;
inline constexpr int kMaxChannelName = 63;     ///< bytes; LCM's own limit
inline constexpr int kMaxProcessText = 64;     ///< bytes
inline constexpr int kMaxBuildIdText = 256;    ///< bytes
inline constexpr int kMaxPlatformText = 1024;  ///< bytes
inline constexpr int kMaxWaitingText = 1024;   ///< bytes
inline constexpr int kMaxYamlText = 50'000;    ///< bytes
inline constexpr int kMaxDetailText = 2048;    ///< bytes
inline constexpr int kMaxModeText = 64;        ///< bytes
inline constexpr int kMaxWhyText = 256;        ///< bytes
inline constexpr int kMaxExposures = 256;      ///< regions in a FlightResult
inline constexpr int kMaxRegionText = 16'384;  ///< bytes of all region names together

}  // namespace tern
