// What a log holds of sensors and of the truth: all that a predictor is judged by.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/world/observation.h"

namespace tern::calibrate {

/// An observation set, and when it was received.
struct Received {
  UTime at;
  ObservationSet set;
};

/// Where one obstacle was, by time.
struct TruePath {
  Vec3 half_extents = Vec3::Zero();  ///< m
  std::map<UTime, Vec3> centres;     ///< W, m
  /// Straight between two samples at most kTruthGap apart. @return nullopt where there are none.
  [[nodiscard]] std::optional<Vec3> at(UTime t) const;
};
inline constexpr double kTruthGap = 0.15;  ///< s

struct Recording {
  std::string name;                        ///< the log's
  std::vector<Received> observations;      ///< in the order of their coming
  std::map<std::int64_t, TruePath> truth;  ///< by obstacle; empty where nobody knew
};

/// OBSTACLE_OBSERVATIONS and OBSTACLE_TRUTH of a log. Times are the vehicle's. @return an Error that names path and
/// reason where the log cannot be read, or holds no observations.
Result<Recording> read_recording(const std::string& path);

}  // namespace tern::calibrate
