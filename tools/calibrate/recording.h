// The observations and the truth of one recorded or synthetic flight.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/observation.h"

namespace tern::calibrate {

/// An observation set with its time of arrival.
struct Received {
  UTime at;
  ObservationSet set;
};

/// The true motion of one obstacle.
struct TruePath {
  Vec3 half_extents = Vec3::Zero();  ///< m
  std::map<UTime, Vec3> centres;     ///< W, m
  /// Returns the centre at t, linear between two samples at most kTruthGap apart. nullopt if there are none.
  [[nodiscard]] std::optional<Vec3> at(UTime t) const;
};
inline constexpr double kTruthGap = 0.15;  ///< s

struct Recording {
  std::string name;                        ///< the log's path, or the synthetic source
  std::vector<Received> observations;      ///< in order of arrival
  std::map<std::int64_t, TruePath> truth;  ///< by obstacle; empty if the log has no OBSTACLE_TRUTH
};

/// Reads OBSTACLE_OBSERVATIONS and OBSTACLE_TRUTH of a log. Times are the vehicle's. @return an Error with path and
/// reason for an unreadable log, or one without observations.
Result<Recording> read_recording(const std::string& path);

}  // namespace tern::calibrate
