// Recorded tracks of people or things, read from text files of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/scenario/scenario.h"
#include "simulator/worlds/track_rows.h"

namespace tern {

inline constexpr std::size_t kMaxTrackFileBytes = 64u << 20;
inline constexpr double kMaxFrameRate = 1e9;  ///< 1/s: times in nanoseconds

/// A recorded path: straight lines between frames; absent before the first and after the last.
struct RecordedTrack {
  std::int64_t id = 0;                          ///< TrackRow::id
  std::vector<std::pair<double, Vec3>> points;  ///< (time in s, box centre in W, m), times ascending, ≥ 1
  int part = 0;                                 ///< of a track that is cut at its gaps, from 0
  std::string name;                             ///< the id as in the file
};

/// The tracks of a file, and what the user should know of them.
struct RecordedFile {
  std::vector<RecordedTrack> tracks;  ///< sorted by id, then by time
  std::vector<std::string> remarks;   ///< whole sentences: rows that are left out, cuts, jumps
};

/// Parses the tracks of a file's text; read_track_rows() has the form of a row.
///
/// | in the file                                          | effect                                                   |
/// |------------------------------------------------------|----------------------------------------------------------|
/// | a time beyond ±1e5 s, as Unix times are              | all times count from the first one                       |
/// | rows of an id not in the order of time               | sorted                                                   |
/// | a second row of an id and microsecond                | left out, counted                                        |
/// | a row less than spec.least_step_s after the last one | left out                                                 |
/// | a row without a finite number                        | left out, counted                                        |
/// | no row of an id for 10 median steps and 2 s          | the track is cut: an id may be reused                    |
/// | one row alone between two gaps                       | left out, counted                                        |
/// | a step above 50 m/s, or 10 m/s and 5 median steps    | remark: an id may have changed its owner                 |
///
/// A time is frame / spec.frames_per_second, s.
/// @param name  name of the file in errors and remarks
/// @return an Error for
///  - the faults of read_track_rows(), or no rows,
///  - times that span more than 1e5 s, or
///  - impossible column indices, unit or rate of the spec.
Result<RecordedFile> parse_recorded_tracks(std::string_view text, const std::string& name,
                                           const RecordedTracksSpec& spec);

/// Finds `file`: itself if absolute, else in the folder of `scenario_file`, else in `data_dir` ("": none).
/// @return the first path that exists, or an Error with all paths tried.
Result<std::string> find_track_file(const std::string& file, const std::string& scenario_file,
                                    const std::string& data_dir);

/// Reads a file of at most kMaxTrackFileBytes by parse_recorded_tracks. No other function of the simulator's libraries
/// reads a file.
Result<RecordedFile> load_recorded_tracks(const std::string& path, const RecordedTracksSpec& spec);

/// Returns the file's time at world time 0, for a spec whose start_s is given. It is start_s; with
/// spec.wait_for_clear_start it is the time of the first whole frame number from there on with a clear start. The file
/// may have no row of that frame.
///
/// The start is clear if for kStartQuiet no recorded position comes within kStartClearance of `start` on the floor,
/// sampled at most 10 ms apart.
/// @return an Error if no frame up to the last recorded one is clear.
Result<double> recorded_start(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                              const Vec3& start);

/// Returns the tracks as obstacles, with world time 0 at `start_s` of the file: vanishing waypoint motions named
/// "<file's stem>#<id>", further parts of a cut track "<file's stem>#<id>.2" and so on. Tracks that have ended by then,
/// or have only one frame, are left out.
std::vector<ObstacleSpec> recorded_obstacles(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                                             double start_s);

}  // namespace tern
