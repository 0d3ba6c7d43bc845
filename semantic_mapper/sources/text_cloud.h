// Reader of point clouds in plain text: a point per line (.xyz, .txt, .asc, .csv, .pts).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// Reads the points of a text file: a line of numbers each, separated by white space, commas or semicolons.
///
/// * Empty lines, and lines that begin with `#`, are skipped.
/// * A first line of words names the columns, as `x y z label`, `//X Y Z R G B` or `"X","Y","Z","Classification"`. The
///   class is the column `label`; if that is empty, one with a usual name (PointColumns::find).
/// * Without names the first three columns are x, y and z. `label` may then be the number of the class's column, 4 or
///   more; without it the file has `has_labels` false.
/// * A first line with one whole number is the count of points that PTS files begin with; it is not checked.
///
/// Points that cannot be used are left out and counted (CloudFile). Errors name `file`, offset and line:
///
/// * a line of another number of columns than the first, or text instead of a number;
/// * a column that is missing;
/// * more than kMaxCloudPoints points or kMaxTextColumns columns, a line of more than kMaxTextLine bytes.
///
/// O(bytes).
Result<CloudFile> parse_text_cloud(std::span<const std::uint8_t> bytes, const std::string& file,
                                   const PointFrame& frame, const std::string& label = "");

inline constexpr std::size_t kMaxTextColumns = 256;
inline constexpr std::size_t kMaxTextLine = 65'536;

}  // namespace tern
