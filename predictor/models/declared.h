// Declared tracks: cut to the horizon, and merged with the estimated tracks that they do not explain.
#pragma once

#include <numbers>
#include <vector>

#include "core/world/observation.h"
#include "core/world/sighting.h"
#include "core/world/track.h"

namespace tern {

/// A declared track explains a detection whose whole box lies in the declared box grown by α and by a margin. The
/// margin is this many standard deviations of the detection's position, which is 4 σ of a face. A sensor that measures
/// both faces of a box independently knows each face √2 times worse than the centre.
inline constexpr double kExplainedSigmas = 4.0 * std::numbers::sqrt2;
/// The margin is at most this, m: a person whose box sticks out farther has a track, however uncertain the detection
/// is. A declared robot that is seen worse than with σ = 0.05 m may get a second, estimated track.
inline constexpr double kMaxExplainedMargin = 0.3;

/// Returns the declared tracks without the pieces that ended by `now` or begin after now + horizon. The other pieces
/// and their α stay bit for bit, so the first piece may begin before `now`. A track whose pieces all ended keeps its
/// last one, and its region grows at its top speed. Static tracks stay as they are. The order is kept.
std::vector<Track> trimmed(const std::vector<Track>& declared, UTime now, Duration horizon);

/// A declared track explains detections from this long before its first piece until this long after its last one,
/// because sensors are late. A region that has grown for longer would hide other obstacles.
inline constexpr Duration kExplainedSlack{300'000};

/// Returns the set without the detections that declared tracks explain. They have a declared track's id, or their box
/// lies in a declared region at the time of the observation (kExplainedSigmas, kMaxExplainedMargin,
/// kExplainedSlack). A detection that sticks out of every region is another obstacle, or one larger than declared, and
/// is estimated. O(detections · tracks).
ObservationSet without_explained(ObservationSet observations, const std::vector<Track>& declared);

/// The same for sightings: the margin is kExplainedSigmas/√2 of the worse bound, or the same maximum.
SightingSet without_explained(SightingSet sightings, const std::vector<Track>& declared);

/// Returns the declared tracks together with the estimated tracks that they do not explain at `now`. An estimated track
/// is explained if its box, without its α, lies within a declared region. An unexplained estimate replaces a declared
/// track with the same id, because ids are unique. Ascending by id.
std::vector<Track> merged(std::vector<Track> declared, const std::vector<Track>& estimated, UTime now);

}  // namespace tern
