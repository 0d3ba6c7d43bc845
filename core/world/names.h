// The printed words of the messages' enumerators, for all programs, scripts and files.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/wire/health.h"
#include "core/world/flight_result.h"
#include "core/world/flyable.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/track.h"
#include "core/world/track_bounds.h"
#include "core/world/vehicle_status.h"
#include "core/world/voxel_map.h"

namespace tern {

/// The word of each enumerator of E, by its number. lcmtypes/ has the same names in capitals.
template <class E>
inline constexpr std::array<const char*, 0> kWords{};
template <>
inline constexpr std::array<const char*, kPlanOutcomes> kWords<PlanOutcome>{"optimized", "search only",
                                                                            "keep committed", "evade", "no plan"};
template <>
inline constexpr std::array<const char*, kPlanReasons> kWords<PlanReason>{
    "none",           "infeasible", "out of time", "start in collision", "goal blocked", "stale world",
    "solver failure", "worse plan", "at goal"};
template <>
inline constexpr std::array<const char*, kPhases> kWords<Phase>{"durations", "evasion", "room"};
template <>
inline constexpr std::array<const char*, kStages> kWords<Stage>{"fallback", "local goal",   "broad phase",
                                                                "search",   "optimization", "check"};
template <>
inline constexpr std::array<const char*, 4> kWords<FlightOutcome>{"reached", "collision", "timeout", "failed"};
template <>
inline constexpr std::array<const char*, 3> kWords<GoalMode>{"go", "hold", "stop"};
template <>
inline constexpr std::array<const char*, 3> kWords<TrackKind>{"static", "declared", "estimated"};
template <>
inline constexpr std::array<const char*, kMotionKinds> kWords<MotionKind>{"new",    "young",  "steady", "calm",
                                                                          "lively", "learnt", "resting"};
template <>
inline constexpr std::array<const char*, kBoundRules> kWords<BoundRule>{"model", "prior", "measured", "reach"};
template <>
inline constexpr std::array<const char*, kVoxelLabels> kWords<VoxelLabel>{"unknown", "free", "occupied", "attractive",
                                                                          "repulsive"};
template <>
inline constexpr std::array<const char*, 5> kWords<ProcessState>{"starting", "waiting", "ready", "finished", "failed"};
template <>
inline constexpr std::array<const char*, kEstimatorHealths> kWords<EstimatorHealth>{"good", "degraded", "lost"};
template <>
inline constexpr std::array<const char*, kRejections> kWords<Rejection>{
    "length",       "fingerprint", "count",  "number",   "enumeration",    "time",
    "inconsistent", "future",      "sender", "repeated", "unauthenticated"};

template <>
inline constexpr std::array<const char*, kBreaches> kWords<Breach>{
    "none",   "shape", "start",     "join",       "end",    "velocity",      "acceleration",   "jerk",
    "thrust", "tilt",  "body rate", "flight box", "sphere", "not separated", "too many planes"};

/// An enumeration whose enumerators have words.
template <class E>
concept Named = !kWords<E>.empty();

/// Returns the word: "search only". @throws std::out_of_range if no enumerator has this value
template <Named E>
constexpr const char* to_string(E value) {
  return kWords<E>.at(idx(value));
}

/// Returns the word as files and scripts write it: "search_only".
template <Named E>
std::string key(E value) {
  std::string text = to_string(value);
  for (char& c : text) c = c == ' ' ? '_' : c;
  return text;
}

/// Returns the enumerator with this word, or nullopt if there is none.
template <Named E>
std::optional<E> named(std::string_view words) {
  for (std::size_t k = 0; k < kWords<E>.size(); ++k) {
    if (kWords<E>[k] == words) return static_cast<E>(k);
  }
  return std::nullopt;
}

}  // namespace tern
