// Checks of the inputs: the usable parts of each.
#pragma once

#include <vector>

#include "core/world/inertial.h"
#include "estimator/estimate.h"

namespace tern {

/// Whether all numbers are finite and of a size that an IMU measures.
bool is_usable(const ImuSample& sample);

/// Whether position and variances are finite, and the variances positive.
bool is_usable(const PositionFix& fix);

/// A frame without its unusable features, and what was wrong with it.
struct CheckedFrame {
  FeatureFrame frame;
  std::vector<Trouble> troubles;
  bool refused = false;  ///< the camera is unusable, or its images are swapped
};
CheckedFrame checked(FeatureFrame frame);

/// Whether both frames have the same features at the same coordinates, to the last bit: the image did not change. False
/// for fewer than kLeastForStuck features.
bool is_same_image(const FeatureFrame& a, const FeatureFrame& b);
inline constexpr int kLeastForStuck = 8;

}  // namespace tern
