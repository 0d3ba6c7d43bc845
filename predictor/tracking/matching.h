// Which detection of a set belongs to which track.
#pragma once

#include <functional>
#include <vector>

#include "core/world/observation.h"
#include "predictor/tracking/tracked_object.h"

namespace tern {

/// A detection belongs to a track only if Σ over axes (z − x)²/S is at most this: χ² of three degrees of freedom,
/// 0.9999.
inline constexpr double kAssociationGate = 21.1;
inline constexpr int kNoDetection = -1;

/// How unlikely a detection is of a track (Fit::surprise), infinite beyond the gate.
using MatchCost = std::function<double(const TrackedObject&, const Detection&)>;
/// A box that holds all detections of at most this variance (m²) whose surprise of the track is finite. Most pairs of a
/// track and a detection are told apart by that.
using GateBox = std::function<Box(const TrackedObject&, const Vec3& variance)>;

struct Matching {
  std::vector<int> detection_of;       ///< per track, an index or kNoDetection
  std::vector<bool> taken, anonymous;  ///< per detection: it has a track; it is matched by likelihood
};

/// By id, unless ids were exchanged: the detection is not where the track of its id can be, but where another one can.
/// The others by the most likely assignment (the least sum of surprises), first to confirmed tracks, then to tentative
/// ones. A track without a detection costs more than any pair within the gate, so who is alone with one gets it.
Matching match(const std::vector<TrackedObject>& objects, const std::vector<Detection>& detections,
               const MatchCost& match_cost, const GateBox& gate_box);

}  // namespace tern
