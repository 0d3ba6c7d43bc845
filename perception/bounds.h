// The six bounds of a fitted cluster, and the visibility of each.
#pragma once

#include "core/world/sighting.h"
#include "perception/clusters.h"
#include "perception/corner_fit.h"

namespace tern {

/// Returns the sighting of group g.
///
/// Every ray that fits is put on its face, which removes its noise. The extremes of these points per axis are the
/// bounds. A bound on the side of a fitted face is the face.
///
/// The flag of a bound comes from the pixels beside the cluster. A pixel votes for the bound that its ray passes first,
/// or else for a near bound that it leads to. Its ray meets the continued face at some depth:
///
/// | the pixel measured                       | vote     |
/// |------------------------------------------|----------|
/// | farther than the face by 3σ + 5 cm, or nothing in range | Whole    |
/// | nearer by that, or could not measure     | Occluded |
/// | the same depth                           | Touching |
/// | – (outside the picture, or the face continues beyond the range) | Cut |
///
/// More than a fifth of the votes for Occluded, Touching or Cut make the bound that. A Whole bound lies between the
/// outermost point and the innermost ray that passed beyond it. The middle is reported, with the σ of a uniform error.
/// A bound without votes faces away from the sensor: Unseen.
///
/// A weak face whose ends along the other axes are not all Whole may be the side of something hidden. It is Occluded,
/// Cut or Touching as they are.
///
/// σ of a face is c·(Σ 1/(σ_i d_i)²)^−½ + 1 cm, with c = 1 for white noise and 0.6 · block otherwise.
/// Near the range, far rays are missing, and the mean of the others is too near: σ(z) is added.
Sighting bounds_of(const DepthPicture& picture, const Clusters& clusters, int g, const ClusterRays& rays,
                   const Corner& corner);

}  // namespace tern
