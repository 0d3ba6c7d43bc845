// Reads the rows of a recording: text files of numbers as motion capture, SLAM and spreadsheets write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/scenario/scenario.h"

namespace tern {

inline constexpr std::size_t kMaxTrackRows = 2'000'000;
inline constexpr int kMaxTrackColumns = 100;

/// Ids that are text count from here, in the order of their appearance; numbers are at most half as large.
inline constexpr std::int64_t kFirstTextId = 2'000'000'000'000'000;

/// One position of a recording.
struct TrackRow {
  std::int64_t id = 0;    ///< 0 if the file is one track; from kFirstTextId on: TrackRows::text_ids
  double frame = 0.0;     ///< as in the file
  Vec3 p = Vec3::Zero();  ///< W, m
  std::size_t line = 0;   ///< counts from 1
};

struct TrackRows {
  std::vector<TrackRow> rows;         ///< in the file's order
  std::vector<std::string> text_ids;  ///< at k, the text of id kFirstTextId + k, at most 40 bytes of it
  std::int64_t not_finite = 0;        ///< rows left out: frame, id or a coordinate is NaN, infinite or empty
};

/// Reads the rows of a file's text.
///
/// 1. A byte order mark at the file's begin is skipped, as are blank lines and lines that begin with '#'.
/// 2. Columns are separated by semicolons if the line has one, else by commas if it has one, else by white space.
/// 3. A first line without a number in any column that is used is a header, and skipped.
/// 4. An id is a whole number or text. Other columns may hold any text. A row has exactly spec.columns columns.
/// 5. z is read if spec.z_column is set, otherwise it is spec.centre_z.
///
/// @param name  name of the file in errors
/// @return an Error "name:line: …" with value and limit, for
///  - a wrong number of columns, or text in a column that must hold a number,
///  - a fractional id, or a coordinate beyond WorldObstacle::kMaxCoordinate, or
///  - too many rows.
Result<TrackRows> read_track_rows(std::string_view text, const std::string& name, const RecordedTracksSpec& spec);

}  // namespace tern
