// The declared model: passes on what owners promise, and lets it win over what is merely seen.
#pragma once

#include <numbers>
#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"

namespace tern {

/// A detection is a declared track's if its whole box lies in the declared one, grown by α and by this many standard
/// deviations of its position: 4 of a face's. A sensor that measures both faces of a box independently knows each √2
/// times worse than the centre between them.
inline constexpr double kExplainedSigmas = 4.0 * std::numbers::sqrt2;

/// The declared tracks over [now, now + horizon]: pieces that ended by `now` and pieces that begin after now + horizon
/// go, the others stay bit for bit with their α (the first one begins when it began). A track that is over keeps its
/// last piece, so that its region goes on growing at its top speed; Static tracks stay as they are. Order is kept.
std::vector<Track> trimmed(const std::vector<Track>& declared, UTime now, Duration horizon);

/// A declared track explains detections while its pieces last, and this much before and after (sensors are late). Not
/// longer: a region that has grown for seconds would hide whatever else is there.
inline constexpr Duration kExplainedSlack{300'000};

/// The set without the detections that declared tracks explain: those with a declared track's id, and those whose box
/// lies in a declared region at the time of the observation (kExplainedSigmas, kExplainedSlack). What sticks out of it
/// is something else, or a thing larger than its owner says, and is estimated. O(detections · tracks).
ObservationSet without_explained(ObservationSet observations, const std::vector<Track>& declared);

/// The declared tracks, and those estimated ones that they do not explain at `now`: whose box, without its α, is not
/// within a declared region. Where an estimate has the id of a
/// declared track that is over, the estimate replaces it: ids are unique. By id ascending.
std::vector<Track> merged(std::vector<Track> declared, const std::vector<Track>& estimated, UTime now);

}  // namespace tern
