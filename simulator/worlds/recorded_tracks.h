// Recorded tracks of people or things, read from text files of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/world/scenario.h"

namespace tern {

inline constexpr std::size_t kMaxTrackFileBytes = 64u << 20;
inline constexpr std::size_t kMaxTrackRows = 2'000'000;
inline constexpr int kMaxTrackColumns = 64;

/// A recorded path: straight lines between frames; absent before the first and after the last.
struct RecordedTrack {
  std::int64_t id = 0;  ///< as in the file; 0 if the file is one track
  std::vector<std::pair<double, Vec3>>
      points;  ///< (frame / frames_per_second, box centre in W, m), times ascending, ≥ 1
};

/// Parses the tracks of a file's text, sorted by id.
///
/// A line holds exactly spec.columns numbers. Blank lines and lines that begin with '#' are skipped. z is read if
/// spec.z_column is set, otherwise it is spec.centre_z. Rows of one id have ascending frames; rows of several ids may
/// be mixed. A row less than spec.least_step_s after the last kept row of its id is skipped.
/// @param name  name of the file in errors
/// @return an Error "name:line: …" with value and limit, for
///  - a wrong number of columns, a number that is infinite or NaN, a fractional id,
///  - descending frames, an excess of rows, coordinates beyond WorldObstacle::kMaxCoordinate, or
///  - impossible column indices, unit or rate of the spec.
Result<std::vector<RecordedTrack>> parse_recorded_tracks(std::string_view text, const std::string& name,
                                                         const RecordedTracksSpec& spec);

/// Finds `file`: itself if absolute, else in the folder of `scenario_file`, else in `data_dir` ("": none).
/// @return the first path that exists, or an Error with all paths tried.
Result<std::string> find_track_file(const std::string& file, const std::string& scenario_file,
                                    const std::string& data_dir);

/// Reads a file of at most kMaxTrackFileBytes by parse_recorded_tracks. No other function of the simulator's libraries
/// reads a file.
Result<std::vector<RecordedTrack>> load_recorded_tracks(const std::string& path, const RecordedTracksSpec& spec);

/// Returns the time of the file at world time 0, if it is not drawn: spec.start_s. With spec.wait_for_clear_start it is
/// the first whole frame number from there on with a clear start. The file may have no row of that frame.
///
/// The start is clear if for kStartQuiet no recorded position comes within kStartClearance of `start` on the floor,
/// sampled at most 10 ms apart.
/// @return an Error if no frame up to the last recorded one is clear.
Result<double> recorded_start(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                              const Vec3& start);

/// Returns the tracks as obstacles, with world time 0 at `start_s` of the file: vanishing waypoint motions named
/// "<file's stem>#<id>". Tracks that have ended by then, or have only one frame, are left out.
std::vector<ObstacleSpec> recorded_obstacles(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                                             double start_s);

}  // namespace tern
