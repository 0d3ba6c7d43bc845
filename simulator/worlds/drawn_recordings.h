// Random choices from a recording: the moment at which a flight begins, and movers that fly pieces of its tracks.
#pragma once

#include <vector>

#include "core/base/random.h"
#include "core/base/result.h"
#include "core/scenario/scenario.h"
#include "simulator/worlds/recorded_tracks.h"

namespace tern {

/// A track is met if it comes this near to the vehicle on the floor, m. For this test the vehicle flies straight from
/// start to goal at constant speed, and arrives after the rest-to-rest bound.
inline constexpr double kMeetingDistance = 1.0;

/// Draws the frame of the recording at which a flight begins, and repeats the draw until a track is met. Tracks that
/// crowd the start (crowds_start) are not met. @return the time of the file, s; an Error after 10,000 draws.
Result<double> draw_start(Rng& rng, const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                          const UavSpec& uav);

/// Whether a track comes within kStartClearance of `start` on the floor, in the first kStartQuiet after file time t_s.
bool crowds_start(const RecordedTrack& track, double t_s, const Vec3& start);

struct ScatteredCopies {
  std::vector<ObstacleSpec> obstacles;
  int redrawn = 0;  ///< draws that came within kStartClearance of the start in the first kStartQuiet
};

/// Makes spec.copies movers, named "<file's stem>~<k>". Each flies a piece of a track that lasts `duration_s`, or less
/// if the track is shorter: then it rests at its end.
///
/// Drawn in this order: track, beginning of the piece, turn about z, mirrored in x or not, place of the bounding box.
/// The box's centre is uniform on each axis on which the box fits into spec.within. On the other axes it is in the
/// middle.
/// @return an Error if 1000 draws in a row come too near to the start.
Result<ScatteredCopies> scatter_copies(Rng& rng, const std::vector<RecordedTrack>& tracks,
                                       const RecordedTracksSpec& spec, const Vec3& start, double duration_s);

}  // namespace tern
