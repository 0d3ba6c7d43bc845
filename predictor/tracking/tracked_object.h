// One thing that is tracked.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/models/axis_filter.h"
#include "predictor/models/learnt_model.h"
#include "predictor/models/model_bank.h"

namespace tern {

/// One tracked thing, all at the time of the tracker's state.
struct TrackedObject {
  std::int64_t id = 0;
  bool confirmed = false;
  std::uint32_t hits = 1;  ///< bit k: detected in the set k sets ago, of those that count (Tracker)
  int age = 1;             ///< sets since birth that count, this one included
  UTime last_seen;
  std::int32_t last_seen_by = 0;  ///< sensor_id
  Vec3 half_extents = Vec3::Zero();
  UTime born;                                             ///< when `moving` began
  int detections = 1;                                     ///< since then
  Vec3 position = Vec3::Zero(), variance = Vec3::Zero();  ///< of the last detection: W, m; m²
  BankFilter moving;
  LearntInput learnt_input;           ///< of `moving`, at the last detection
  std::array<AxisFilter, 3> resting;  ///< with kRestingSigma, since resting_since
  UTime resting_since;
  double resting_average = 3.0;  ///< of its χ²₃, see kRestingLimit
  /// Where it rested until the resting hypothesis failed. It has started once it is beyond kJumpGate of that; noise
  /// alone comes back.
  std::optional<std::array<AxisFilter, 3>> stood;
};

}  // namespace tern
