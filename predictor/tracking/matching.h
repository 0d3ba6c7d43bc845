// Matches the detections of one observation set to tracks. Step 2 of docs/prediction.md.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/world/observation.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// The gate of Σ over axes (z − x)²/S within which a detection may belong to a track. It is the 0.9999 quantile of χ²
/// with three degrees of freedom.
inline constexpr double kAssociationGate = 21.1;
inline constexpr int kNoDetection = -1;
/// A track is matched with one of the nearest so many detections within its gate. More lie there only in a flood of
/// false detections.
inline constexpr std::size_t kMaxCandidates = 32;

/// The cost of matching a detection to a track (Fit::neg_log_likelihood); infinite beyond the gate.
using MatchCost = std::function<double(const TrackedObject&, const Detection&)>;
/// A box that contains every detection with at most this variance (m²) whose cost is finite. It rejects most pairs of
/// track and detection.
using GateBox = std::function<Box(const TrackedObject&, const Vec3& variance)>;

struct Matching {
  std::vector<int> detection_of;  ///< per track: an index, or kNoDetection
  std::vector<bool> taken;        ///< per detection: it belongs to a track
  std::vector<bool> anonymous;    ///< per detection: it is matched by cost instead of by id
};

/// Matches in four passes:
/// 1. A detection with an id goes to the track of that id. If it lies outside that track's gate and inside another
///    one's, ids were exchanged, and the id is ignored.
/// 2. All other detections go to confirmed tracks, by the assignment with the least total cost.
/// 3. The remaining ones go to tentative tracks in the same way.
/// 4. A detection that is still free goes to the track of its id, if that is free.
/// A track without a detection costs more than any pair within the gate, so as many pairs as possible are made.
///
/// It takes O(t log d) for t tracks and d detections, and kMaxCandidates costs for each track at most. If all
/// detections lie in the gates of all tracks, it also compares t·d positions.
/// @pre objects ascend by id
Matching match(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
               const MatchCost& match_cost, const GateBox& gate_box);

}  // namespace tern
