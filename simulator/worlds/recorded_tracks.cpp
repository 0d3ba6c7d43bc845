#include "simulator/worlds/recorded_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include "simulator/worlds/generators.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

constexpr double kClearSample = 0.01;  // s

std::string wrong_spec(const RecordedTracksSpec& spec) {
  if (spec.columns < 1 || spec.columns > kMaxTrackColumns) {
    return fmt::format("columns {}, not in [1, {}]", spec.columns, kMaxTrackColumns);
  }
  for (const int c :
       {std::max(spec.id_column, 0), spec.frame_column, spec.x_column, spec.y_column, spec.z_column.value_or(0)}) {
    if (c < 0 || c >= spec.columns) return fmt::format("column {} of {}: columns count from 0", c, spec.columns);
  }
  if (!(spec.metres_per_unit > 0.0 && spec.metres_per_unit <= 1e6)) {
    return fmt::format("metres_per_unit {}, not in (0, 1e6]", spec.metres_per_unit);
  }
  if (!(spec.frames_per_second > 0.0 && spec.frames_per_second <= kMaxFrameRate)) {
    return fmt::format("frames_per_second {}, not in (0, {:g}]", spec.frames_per_second, kMaxFrameRate);
  }
  return {};
}

/// A track is cut where it has no position for longer than this: for kGapSteps of its median steps, and kMinGap.
constexpr double kGapSteps = 10.0;
constexpr double kMinGap = 2.0;  // s
/// A step is called a jump if it is this much faster than the track's median, and than kMinJumpSpeed. A step faster
/// than kMaxSpeed is one in any case: two objects with one id make every step a jump.
constexpr double kJumpRatio = 5.0;
constexpr double kMinJumpSpeed = 10.0;  // m/s
constexpr double kMaxSpeed = 50.0;      // m/s

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the origin of the rows' times, in frames: 0, or the first frame if the times are as large as Unix times.
double origin_of(const std::vector<TrackRow>& rows, double rate) {
  const auto [first, last] = std::ranges::minmax_element(rows, {}, &TrackRow::frame);
  const double most = std::max(std::abs(first->frame), std::abs(last->frame)) / rate;
  return most > WorldObstacle::kMaxCoordinate ? first->frame : 0.0;
}

/// How many rows were treated in which way.
struct RowCounts {
  std::int64_t repeated = 0;  ///< the same id and time as another
  std::int64_t sorted = 0;    ///< tracks whose rows were not in order
  std::int64_t cut = 0;       ///< gaps
  std::int64_t alone = 0;     ///< positions without a neighbour in time
  std::int64_t jumps = 0;
  double fastest = 0.0;  ///< of the jumps, m/s
  std::string fastest_name;
};

/// Sorts the positions by time and leaves out those of the same microsecond, or sooner than least_step_s.
void put_in_order(RecordedTrack& track, double least_step_s, RowCounts& counts) {
  auto& points = track.points;
  const auto by_time = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::ranges::is_sorted(points, by_time)) {
    ++counts.sorted;
    std::ranges::stable_sort(points, by_time);
  }
  auto kept = points.begin();
  for (auto p = points.begin(); p != points.end(); ++p) {
    if (p != points.begin()) {
      const bool is_same = whole_microseconds(p->first) <= whole_microseconds(kept->first);
      counts.repeated += is_same ? 1 : 0;
      if (is_same || p->first < kept->first + least_step_s) continue;
      ++kept;
    }
    *kept = *p;
  }
  if (!points.empty()) points.erase(kept + 1, points.end());
}

/// Counts the steps that are too fast to be a motion.
void find_jumps(const RecordedTrack& track, RowCounts& counts) {
  std::vector<double> speeds;
  for (std::size_t k = 1; k < track.points.size(); ++k) {
    const auto& [t0, p0] = track.points[k - 1];
    const auto& [t1, p1] = track.points[k];
    speeds.push_back((p1 - p0).norm() / (t1 - t0));
  }
  if (speeds.empty()) return;
  const double limit = std::clamp(kJumpRatio * median_of(speeds), kMinJumpSpeed, kMaxSpeed);
  for (const double speed : speeds) {
    if (speed <= limit) continue;
    ++counts.jumps;
    if (speed > counts.fastest) {
      counts.fastest = speed;
      counts.fastest_name = track.name;
    }
  }
}

/// Adds the track, cut at its gaps. A part of a cut track that has one position is left out.
void add_parts(RecordedTrack track, std::vector<RecordedTrack>& parts, RowCounts& counts) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < track.points.size(); ++k) {
    steps.push_back(track.points[k].first - track.points[k - 1].first);
  }
  const double gap = steps.empty() ? 0.0 : std::max(kMinGap, kGapSteps * median_of(steps));
  RecordedTrack part{track.id, {}, 0, track.name};
  const auto finish = [&] {
    find_jumps(part, counts);
    const bool is_alone = part.points.size() == 1 && track.points.size() > 1;
    counts.alone += is_alone ? 1 : 0;
    if (!is_alone) parts.push_back(part);
    part = {track.id, {}, part.part + 1, track.name};
  };
  for (std::size_t k = 0; k < track.points.size(); ++k) {
    if (k > 0 && steps[k - 1] > gap) {
      ++counts.cut;
      finish();
    }
    part.points.push_back(track.points[k]);
  }
  finish();
}

std::vector<std::string> remarks_on(const std::string& name, const TrackRows& rows, double origin,
                                    const RowCounts& counts) {
  std::vector<std::string> remarks;
  const auto remark = [&](bool applies, const std::string& text) {
    if (applies) remarks.push_back(fmt::format("{}: {}", name, text));
  };
  const auto all = static_cast<std::int64_t>(rows.rows.size()) + rows.not_finite;
  remark(origin != 0.0, fmt::format("its times count from the first one, {:.15g}", origin));
  remark(rows.not_finite > 0,
         fmt::format("{} of {} rows are left out: a number is missing or not finite", rows.not_finite, all));
  remark(counts.repeated > 0, fmt::format("{} of {} rows are left out: their track has an earlier row of the same time",
                                          counts.repeated, all));
  remark(counts.sorted > 0,
         fmt::format("the rows of {} tracks were not in the order of time; they are sorted", counts.sorted));
  remark(counts.cut > 0,
         fmt::format("tracks are cut at {} gaps longer than {:g} s and {:g} steps; an id may name different objects",
                     counts.cut, kMinGap, kGapSteps));
  remark(counts.alone > 0, fmt::format("{} positions are left out: they stand alone between gaps", counts.alone));
  remark(counts.jumps > 0,
         fmt::format(
             "{} steps are faster than {:g} m/s, or than {:g} m/s and {:g} times their track's median. The fastest "
             "has {:.3g} m/s, in track {}: an id may have changed its owner",
             counts.jumps, kMaxSpeed, kMinJumpSpeed, kJumpRatio, counts.fastest, counts.fastest_name));
  return remarks;
}

/// Times at which a track is near the start, ascending.
std::vector<double> crowded_instants(const std::vector<RecordedTrack>& tracks, const Vec3& start) {
  std::vector<double> instants;
  const auto look = [&](double t, const Vec3& p) {
    if ((p - start).head<2>().norm() < kStartClearance) instants.push_back(t);
  };
  for (const RecordedTrack& track : tracks) {
    for (std::size_t i = 0; i + 1 < track.points.size(); ++i) {
      const auto& [t0, p0] = track.points[i];
      const auto& [t1, p1] = track.points[i + 1];
      const int parts = std::max(1, static_cast<int>(std::ceil((t1 - t0) / kClearSample)));
      for (int k = 0; k < parts; ++k) {
        const double s = static_cast<double>(k) / parts;
        look(t0 + s * (t1 - t0), p0 + s * (p1 - p0));
      }
    }
    look(track.points.back().first, track.points.back().second);
  }
  std::sort(instants.begin(), instants.end());
  return instants;
}

std::string name_of(std::int64_t id, const TrackRows& rows) {
  return id < kFirstTextId ? fmt::format("{}", id) : rows.text_ids[static_cast<std::size_t>(id - kFirstTextId)];
}

}  // namespace

Result<RecordedFile> parse_recorded_tracks(std::string_view text, const std::string& name,
                                           const RecordedTracksSpec& spec) {
  if (const std::string wrong = wrong_spec(spec); !wrong.empty()) return fail(fmt::format("{}: {}", name, wrong));
  const auto read = read_track_rows(text, name, spec);
  if (!read) return tl::unexpected(read.error());
  if (read->rows.empty()) {
    const std::string why = read->not_finite > 0 ? fmt::format(": {} lack a finite number", read->not_finite) : "";
    return fail(fmt::format("{}: no rows{}", name, why));
  }
  const double origin = origin_of(read->rows, spec.frames_per_second);
  std::map<std::int64_t, RecordedTrack> tracks;
  for (const TrackRow& row : read->rows) {
    const double time = (row.frame - origin) / spec.frames_per_second;
    if (!(std::abs(time) <= WorldObstacle::kMaxCoordinate)) {
      return fail(
          fmt::format("{}:{}: frame {:.15g} is {:.6g} s after the first, beyond {} s: `frames_per_second` is 1 "
                      "for seconds, 1e9 for nanoseconds",
                      name, row.line, row.frame, time, WorldObstacle::kMaxCoordinate));
    }
    RecordedTrack& track = tracks[row.id];
    track.id = row.id;
    if (track.name.empty()) track.name = name_of(row.id, *read);
    track.points.emplace_back(time, row.p);
  }
  RecordedFile file;
  RowCounts counts;
  for (auto& [id, track] : tracks) {
    put_in_order(track, spec.least_step_s, counts);
    add_parts(std::move(track), file.tracks, counts);
  }
  file.remarks = remarks_on(name, *read, origin, counts);
  return file;
}

Result<std::string> find_track_file(const std::string& file, const std::string& scenario_file,
                                    const std::string& data_dir) {
  namespace fs = std::filesystem;
  std::vector<fs::path> places;
  if (fs::path(file).is_absolute()) {
    places.emplace_back(file);
  } else {
    places.push_back(fs::path(scenario_file).parent_path() / file);
    if (!data_dir.empty()) places.push_back(fs::path(data_dir) / file);
  }
  std::string tried;
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored)) return place.string();
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  return fail(fmt::format("recorded tracks '{}': no such file; tried {}{}", file, tried,
                          data_dir.empty() ? " (TERN_DATA names no folder)" : ""));
}

Result<RecordedFile> load_recorded_tracks(const std::string& path, const RecordedTracksSpec& spec) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) return fail(fmt::format("{}: {}", path, error.message()));
  if (size > kMaxTrackFileBytes) return fail(fmt::format("{}: {} bytes, limit {}", path, size, kMaxTrackFileBytes));
  std::ifstream in(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) return fail(fmt::format("{}: cannot be read", path));
  return parse_recorded_tracks(text, path, spec);
}

Result<double> recorded_start(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                              const Vec3& start) {
  const double wanted = spec.start_s.value_or(0.0);
  if (!spec.wait_for_clear_start) return wanted;
  double last_s = -std::numeric_limits<double>::infinity();
  for (const RecordedTrack& track : tracks) last_s = std::max(last_s, track.points.back().first);
  const std::vector<double> crowded = crowded_instants(tracks, start);
  const double rate = spec.frames_per_second;
  for (double frame = std::ceil(wanted * rate); frame / rate <= last_s;) {
    const double t = frame / rate;
    const auto next = std::lower_bound(crowded.begin(), crowded.end(), t);
    if (next == crowded.end() || *next > t + kStartQuiet) return t;
    frame = std::max(frame, std::floor(*next * rate)) + 1.0;
  }
  return fail(fmt::format("{}: no frame from {} s to the last at {} s leaves the start clear by {} m for {} s",
                          spec.file, wanted, last_s, kStartClearance, kStartQuiet));
}

std::vector<ObstacleSpec> recorded_obstacles(const std::vector<RecordedTrack>& tracks, const RecordedTracksSpec& spec,
                                             double start_s) {
  const std::string stem = std::filesystem::path(spec.file).stem().string();
  std::vector<ObstacleSpec> obstacles;
  for (const RecordedTrack& track : tracks) {
    WaypointMotion motion;
    motion.vanish = true;
    motion.leave_out_within_m = spec.leave_out_within_m;
    motion.points.reserve(track.points.size());
    for (const auto& [t, p] : track.points) motion.points.emplace_back(whole_microseconds(t - start_s), p);
    if (motion.points.size() < 2 || motion.points.back().first <= 0.0) continue;
    ObstacleSpec o;
    o.name = fmt::format("{}#{}{}", stem, track.name, track.part > 0 ? fmt::format(".{}", track.part + 1) : "");
    o.half_extents = spec.half_extents;
    o.motion = std::move(motion);
    obstacles.push_back(std::move(o));
  }
  return obstacles;
}

}  // namespace tern
