// The six bounds of a fitted cluster, and the visibility of each.
#pragma once

#include "core/world/sighting.h"
#include "perception/clusters.h"
#include "perception/corner_fit.h"

namespace tern {

/// Returns the sighting of group g.
///
/// Every ray that fits is moved to its face, which removes its noise. On the side of a fitted face the bound is the
/// face, with the flag Face. Elsewhere the bound is the outermost of these points.
///
/// The pixels around the cluster vote on the flags. A pixel votes on the bound that its ray passes first, or else on a
/// near bound that it leads to. The vote compares its measured depth with the depth of the face, continued to its ray:
///
/// | the pixel                                                      | vote     |
/// |----------------------------------------------------------------|----------|
/// | measured more than 3σ + 5 cm farther, or nothing in range      | Whole    |
/// | measured more than 3σ + 5 cm nearer, or could not measure      | Occluded |
/// | measured the same depth                                        | Touching |
/// | lies outside the picture, or the continued face out of range   | Cut      |
///
/// - If more than a fifth of the votes are for Occluded, Touching or Cut, the bound gets the most frequent of these
///   flags. This holds for fitted faces as well.
/// - A Whole bound lies between the outermost point and the innermost ray that passed beyond it. Its place is the
///   middle of both, with the σ of a uniform error. A ray that passed another bound as well may have missed the box
///   there. Such rays count only if there are no others.
/// - A bound without votes faces away from the sensor: Unseen.
/// - A weak face may be the side of something hidden. If one of its ends along the other axes is not Whole, the face
///   gets the flag of that end (Occluded for an Unseen one).
///
/// σ of a face is c·(Σ 1/(σ_i d_i)²)^−½ + 1 cm, with c = 1 for white noise and 0.6 · block otherwise. A weak face has
/// half a pixel more. Near the end of the range the far rays are missing, so the mean is too near: σ(z) is added.
Sighting bounds_of(const DepthPicture& picture, const Clusters& clusters, int g, const ClusterRays& rays,
                   const Corner& corner);

}  // namespace tern
