#include "simulator/worlds/recorded_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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

constexpr double kMaxWholeId = 1e15;
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
  if (!(spec.frames_per_second > 0.0 && spec.frames_per_second <= 1e5)) {
    return fmt::format("frames_per_second {}, not in (0, 1e5]", spec.frames_per_second);
  }
  return {};
}

/// Cuts the next word off `line`.
std::string_view next_word(std::string_view& line) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = line.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  line.remove_prefix(begin);
  const std::string_view word = line.substr(0, line.find_first_of(kBlank));
  line.remove_prefix(word.size());
  return word;
}

std::optional<double> to_number(std::string_view word) {
  if (word.size() > 1 && word.front() == '+') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Fills `numbers`. @return the fault of the line, or ""
std::string read_row(std::string_view line, int columns, std::vector<double>& numbers) {
  numbers.clear();
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    const std::optional<double> value = to_number(word);
    if (!value) return fmt::format("'{}' is not a finite number", word.substr(0, 40));
    numbers.push_back(*value);
    if (numbers.size() > static_cast<std::size_t>(columns)) break;
  }
  if (numbers.size() == static_cast<std::size_t>(columns)) return {};
  return fmt::format("{} columns{}, {} expected", numbers.size(),
                     numbers.size() > static_cast<std::size_t>(columns) ? " or more" : "", columns);
}

/// Adds a row to the tracks. @return its fault, or ""
std::string add_row(const std::vector<double>& row, const RecordedTracksSpec& spec,
                    std::map<std::int64_t, RecordedTrack>& tracks) {
  const auto number = [&](int column) { return row[idx(column)]; };
  const double id = spec.id_column < 0 ? 0.0 : number(spec.id_column);
  if (id != std::floor(id) || std::abs(id) > kMaxWholeId) return fmt::format("id {} is not a whole number", id);
  const double time = number(spec.frame_column) / spec.frames_per_second;
  if (std::abs(time) > WorldObstacle::kMaxCoordinate) {
    return fmt::format("frame {} is at {} s, beyond {} s", number(spec.frame_column), time,
                       WorldObstacle::kMaxCoordinate);
  }
  const double unit = spec.metres_per_unit;
  const Vec3 p(number(spec.x_column) * unit, number(spec.y_column) * unit,
               spec.z_column ? number(*spec.z_column) * unit : spec.centre_z);
  if (!(p.cwiseAbs().maxCoeff() <= WorldObstacle::kMaxCoordinate)) {
    return fmt::format("position ({}, {}, {}) m, beyond {} m", p.x(), p.y(), p.z(), WorldObstacle::kMaxCoordinate);
  }
  RecordedTrack& track = tracks[static_cast<std::int64_t>(id)];
  track.id = static_cast<std::int64_t>(id);
  if (!track.points.empty() && !(whole_microseconds(time) > whole_microseconds(track.points.back().first))) {
    return fmt::format("id {}: frame {} after frame {}, frames must ascend", track.id, number(spec.frame_column),
                       track.points.back().first * spec.frames_per_second);
  }
  if (!track.points.empty() && time < track.points.back().first + spec.least_step_s) return {};
  track.points.emplace_back(time, p);
  return {};
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

}  // namespace

Result<std::vector<RecordedTrack>> parse_recorded_tracks(std::string_view text, const std::string& name,
                                                         const RecordedTracksSpec& spec) {
  if (const std::string wrong = wrong_spec(spec); !wrong.empty()) return fail(fmt::format("{}: {}", name, wrong));
  std::map<std::int64_t, RecordedTrack> tracks;
  std::vector<double> row;
  std::size_t line_number = 0;
  std::size_t rows = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    std::string_view rest = line;
    const std::string_view first = next_word(rest);
    if (first.empty() || first.front() == '#') continue;
    std::string wrong = read_row(line, spec.columns, row);
    if (wrong.empty()) wrong = add_row(row, spec, tracks);
    if (wrong.empty() && ++rows > kMaxTrackRows) wrong = fmt::format("more than {} rows", kMaxTrackRows);
    if (!wrong.empty()) return fail(fmt::format("{}:{}: {}", name, line_number, wrong));
  }
  if (tracks.empty()) return fail(fmt::format("{}: no rows", name));
  std::vector<RecordedTrack> sorted;
  sorted.reserve(tracks.size());
  for (auto& [id, track] : tracks) sorted.push_back(std::move(track));
  return sorted;
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

Result<std::vector<RecordedTrack>> load_recorded_tracks(const std::string& path, const RecordedTracksSpec& spec) {
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
    o.name = fmt::format("{}#{}", stem, track.id);
    o.half_extents = spec.half_extents;
    o.motion = std::move(motion);
    obstacles.push_back(std::move(o));
  }
  return obstacles;
}

}  // namespace tern
