// The hypothesis that a track rests on one axis of W. docs/prediction/rest_on_an_axis.md.
#pragma once

#include <array>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "predictor/models/axis_filter.h"
#include "predictor/tracking/rest_record.h"

namespace tern {

/// The hypothesis that a track rests on one axis of W, whatever it does on the others.
struct AxisRest {
  AxisFilter filter;  ///< a constant velocity (kRestingSigma), since `since`
  UTime since;
  double average = 1.0;  ///< of its χ²₁, see kAxisRestLimit
  /// The place of rest, after the hypothesis failed there. A detection beyond kJumpGate of it confirms a start.
  std::optional<AxisFilter> stood;
};

/// The records of rest on x, y and z of W, each of all tracks. Obstacles of a world often keep to a height, or to a
/// way.
using AxisRestRecords = std::array<RestRecord, 3>;

}  // namespace tern
