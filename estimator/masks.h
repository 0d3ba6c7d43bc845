// Masks: parts of the image whose features are not used, because they belong to things that move.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/frames.h"
#include "core/world/inertial.h"

namespace tern {

/// Where features are not used.
struct Masks {
  std::vector<Eigen::AlignedBox2d> image;  ///< rectangles of the left image, normalized coordinates
  std::vector<Box> boxes_W;                ///< in W, m, at the time of the frame: a predicted box with its α
};

/// Whether the ray of the feature meets a box in front of it. With a right view, the feature must not lie nearer than
/// the box by more than its error (3 σ of the disparity). A box that contains the camera is left out: it
/// would hide every feature.
/// @param pose  of B at the time of the exposure
bool may_lie_on(const FeatureFrame& frame, const StereoFeature& feature, const PoseInW& pose, const Box& box_W);

/// Returns the frame without the features in masked parts. Cost: features × masks.
/// @param pose  of B at the time of the exposure
FeatureFrame unmasked(FeatureFrame frame, const Masks& masks, const PoseInW& pose);

}  // namespace tern
