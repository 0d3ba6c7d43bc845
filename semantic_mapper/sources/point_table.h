// Points as rows of named columns, as PLY, PCD and text files have them.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "semantic_mapper/sources/point_cloud.h"

namespace tern {

/// The type of a column's numbers.
enum class NumberType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64, Int64, Uint64 };

/// Returns the size of a binary number, bytes.
std::size_t size_of(NumberType type);

/// The columns of a file, and which of them are the position and the class.
struct PointColumns {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<std::string> names;  ///< in the file's order
  std::vector<NumberType> types;   ///< of equal size
  std::size_t position[3] = {kNone, kNone, kNone};
  std::size_t class_number = kNone;  ///< kNone: the file has no class

  /// Finds x, y, z and the class by their names. The class is the column `label`. If `label` is empty, it is the first
  /// of these that the file has: `label`, `class`, `classification`, `class_id`, `semantic`, `scalar_Label`,
  /// `scalar_Classification`. Case does not matter.
  /// @return an error text: the name that is missing, and the names that there are; "" if all are found
  std::string find(std::string_view label);
};

/// The place of a column's numbers in a binary file, bytes: number k lies at first + k · stride.
struct ColumnPlace {
  std::size_t first = 0, stride = 0;
};

/// Collects rows as points.
class PointRows {
 public:
  /// @param columns  outlives this
  PointRows(const PointColumns& columns, const PointFrame& frame, std::size_t count);
  /// Adds a point or counts why it is left out. @param label  ignored if the file has no class
  void add(const Vec3& p_file, double label);
  /// Adds a row. @param values  one per column
  void add(const std::vector<double>& values);
  /// Returns the points. This is empty afterwards.
  CloudFile finish();

 private:
  const PointColumns& columns_;
  PointFrame frame_;
  CloudFile cloud_;
  double largest_float_ = 0.0;  ///< of the float32 coordinates, in the file's units
};

/// Returns the points of a binary file. O(count). @pre the numbers of all columns lie within `bytes`
/// @param places  one per column
CloudFile read_records(std::span<const std::uint8_t> bytes, const PointColumns& columns,
                       const std::vector<ColumnPlace>& places, std::size_t count, std::endian order,
                       const PointFrame& frame);

/// Returns the points of `count` rows of numbers in text, separated by white space, from `at` on. An Error names
/// `file`, offset and row where there is no number, or says that the file is too short for the rows. O(bytes).
Result<CloudFile> read_text_rows(std::span<const std::uint8_t> bytes, std::size_t at, const std::string& file,
                                 const PointColumns& columns, std::size_t count, const PointFrame& frame);

/// Reads one number of a text, and advances `at` behind it. White space before it is skipped. nullopt if there is no
/// number, or if other text follows it without white space between.
std::optional<double> next_number(std::string_view text, std::size_t& at);

/// Returns the words of a line; spaces, tabs, carriage returns and `separators` lie between them.
std::vector<std::string_view> words_of(std::string_view line, std::string_view separators = "");

/// Returns an unsigned number; nullopt if the word is anything else.
std::optional<std::uint64_t> whole_number(std::string_view word);

}  // namespace tern
