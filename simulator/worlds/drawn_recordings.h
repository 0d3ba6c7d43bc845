// What the seed draws from a recording: the moment at which a flight begins, or movers that fly pieces of its tracks.
#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/base/result.h"
#include "core/world/scenario.h"
#include "simulator/worlds/recorded_tracks.h"

namespace tern {

/// Someone is met who comes this near on the floor, m, to a vehicle that flies straight from start to goal. It flies at
/// even speed and arrives after the bound.
inline constexpr double kMeetingDistance = 1.0;

/// A whole frame of the recording at which a flight begins, drawn anew until somebody is met. Who leaves no room for a
/// beginning (crowds_start) meets nobody. @return the time of the file, s; an Error after 10,000 draws.
Result<double> draw_start(Rng& rng, const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                          const UavSpec& uav);

/// Whether a track comes within kStartClearance of `start`, on the floor, in the first kStartQuiet after file time t_s.
bool crowds_start(const RecordedTrack& track, double t_s, const Vec3& start);

struct ScatteredCopies {
  std::vector<ObstacleSpec> obstacles;
  int redrawn = 0;  ///< that came within kStartClearance of the start in the first kStartQuiet
};

/// spec.copies movers, "<file's stem>~<k>", each on a piece of a track that lasts `duration_s` (shorter where the track
/// is: then it rests at its end). Drawn in this order: track, where the piece begins, a turn about z, mirrored in x or
/// not, the place of the piece's bounding box. Its centre is uniform per axis where the box is inside spec.within, in
/// the middle where it is too long.
/// @return an Error when a start refuses 1000 draws in a row.
Result<ScatteredCopies> scatter_copies(Rng& rng, const std::vector<RecordedTrack>& tracks,
                                       const RecordedTracksSpec& spec, const Vec3& start, double duration_s);

}  // namespace tern
