// Matches the sightings of one frame to tracks, face by face.
#pragma once

#include <vector>

#include "core/base/types.h"
#include "core/world/sighting.h"
#include "predictor/faces/face_box.h"

namespace tern {

/// A sighting belongs to a track only if its worst bound differs by less than this, m, and by three standard deviations
/// of the prediction.
inline constexpr double kFaceGate = 0.6, kFaceGateSigmas = 3.0;
/// The largest gate, m. Farther away, the sighting may as well show another obstacle.
inline constexpr double kMaxFaceGate = 2.0;
/// The cost, as a share of the gate, of a pair without a bound that can be compared.
inline constexpr double kNothingCompared = 0.5;

struct PredictedFaces {
  const FaceBox* box = nullptr;
  Vec3 anchor = Vec3::Zero();  ///< predicted to the frame, W, m
  double gate = kFaceGate;     ///< m
};

/// Returns the gate of a track. @param deviation  of the predicted anchor, m
inline double face_gate(double deviation) { return std::min(kMaxFaceGate, kFaceGate + kFaceGateSigmas * deviation); }

inline constexpr int kNoSighting = -1;
/// Returns the index of each track's sighting, or kNoSighting. The best pairs are taken first. A pair's cost is
/// FaceBox::mismatch() plus the track's gate: without the gate, a track with an uncertain place would take the
/// sightings of its neighbours. Ties are resolved by index. O(n log n) for n pairs within their gates, and a comparison
/// of intervals for each pair of track and sighting.
std::vector<int> match_sightings(const std::vector<PredictedFaces>& tracks, const std::vector<Sighting>& sightings);

}  // namespace tern
