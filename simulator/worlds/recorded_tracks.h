// Recorded tracks of people or things, from text files of numbers: the crowd's world.
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

/// One person's path as recorded: straight lines between frames; absent before the first and after the last.
struct RecordedTrack {
  std::int64_t id = 0;  ///< as in the file; 0 where it is one track
  std::vector<std::pair<double, Vec3>>
      points;  ///< (frame / frames_per_second, box centre in W, m), times ascending, ≥ 1
};

/// The tracks of a file's text, by id ascending.
///
/// A line holds exactly spec.columns numbers; blank lines and lines that begin with '#' are passed over. z is read
/// where spec.z_column is set, else spec.centre_z. Rows of one id have ascending frames; rows of several ids may be
/// mixed. A row less than spec.least_step_s after the last one of its id that was kept is passed over.
/// @param name how errors call the file.
/// @return an Error "name:line: …" with value and limit for a wrong number of columns, no finite number, or an id that
///   is not whole. Also for frames out of order, coordinates beyond WorldObstacle::kMaxCoordinate, too many rows, and
///   impossible column indices, unit or rate of the spec.
Result<std::vector<RecordedTrack>> parse_recorded_tracks(std::string_view text, const std::string& name,
                                                         const RecordedTracksSpec& spec);

/// Where `file` is: itself if absolute, else in the folder of `scenario_file`, else in `data_dir` ("": none). The first
/// that exists counts.
/// @return an Error that lists the places tried.
Result<std::string> find_track_file(const std::string& file, const std::string& scenario_file,
                                    const std::string& data_dir);

/// parse_recorded_tracks of a file of at most kMaxTrackFileBytes. The only reading of files in the simulator's
/// libraries.
Result<std::vector<RecordedTrack>> load_recorded_tracks(const std::string& path, const RecordedTracksSpec& spec);

/// The time of the file at which world time is 0, where it is not drawn: spec.start_s itself. With
/// spec.wait_for_clear_start it is that of the first clear whole frame number from there on, recorded or not: a frame
/// may show no one. Clear means that for kStartQuiet no one's recorded position comes within kStartClearance of
/// `start`, measured on the floor. It is sampled at most 10 ms apart.
/// @return an Error when no frame up to the last recorded one is clear.
Result<double> recorded_start(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                              const Vec3& start);

/// The tracks as obstacles of a world whose time 0 is `start_s` of the file: vanishing waypoint motions named
/// "<file's stem>#<id>". Whoever left by then, or was seen in one frame only, is left out.
std::vector<ObstacleSpec> recorded_obstacles(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                                             double start_s);

}  // namespace tern
