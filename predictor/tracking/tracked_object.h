// The state of one track.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/faces/face_box.h"
#include "predictor/models/axis_filter.h"
#include "predictor/models/learnt_model.h"
#include "predictor/models/model_bank.h"
#include "predictor/tracking/axis_rest.h"

namespace tern {

/// One track. Its filters are at the time of the tracker's state. "Counted" sets are defined at Tracker.
struct TrackedObject {
  std::int64_t id = 0;
  bool confirmed = false;
  std::uint32_t hits = 1;  ///< bit k: detected in the counted set k sets ago
  int age = 1;             ///< counted sets since the first detection, that one included
  UTime last_seen;
  std::int32_t last_seen_by = 0;  ///< sensor_id
  Vec3 half_extents = Vec3::Zero();
  UTime born;                                             ///< start of `moving`
  int detections = 1;                                     ///< since then
  Vec3 position = Vec3::Zero(), variance = Vec3::Zero();  ///< of the last detection: W, m; m²
  BankFilter moving;
  LearntInput learnt_input;           ///< of `moving`, at the last detection
  std::array<AxisFilter, 3> resting;  ///< the resting hypothesis (kRestingSigma), since resting_since
  UTime resting_since;
  double resting_average = 3.0;  ///< average of its χ²₃, see kRestingLimit
  /// The place of rest, after the resting hypothesis failed there. A detection beyond kJumpGate of it confirms a start;
  /// after mere noise the track rests there again.
  std::optional<std::array<AxisFilter, 3>> stood;
  std::array<AxisRest, 3> rest_of_axes;
  bool is_sighted = false;  ///< a track by sightings: `moving` and `resting` are about the anchor of `faces`
  FaceBox faces;
  int misses = 0;                 ///< of a track by sightings: looked for and not found, less those found since, ≥ 0
  std::array<int, 3> rejected{};  ///< of a track by sightings, per axis: measurements in a row that were outliers
  bool is_located = true;         ///< the last detection had a position on all axes
  int points = 0;                 ///< of a track by sightings: the most of late, less an eighth at each sighting.
  /// Of a track by sightings: its speed at its last sighting was at most kKnownRest.
  bool is_rest_known = false;
  bool is_doubtful = false;  ///< a track by sightings that began beside tracks that were seen: perhaps a part of them
  std::array<UTime, 3> located_at{};  ///< of a track by sightings, per axis: the last detection with a position there
};

/// A track that is seen with fewer points is coarse. Neighbours often merge into one sighting then, so errors of coarse
/// tracks say little about others.
inline constexpr int kCoarsePoints = 64;
inline bool is_coarse(const TrackedObject& object) { return object.is_sighted && object.points < kCoarsePoints; }

}  // namespace tern
