// Comma-separated values by RFC 4180, except that lines end with LF.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

using CsvRecord = std::vector<std::string>;

/// Returns one record with its line end. Cells with a comma, quote or line break are quoted; quotes in them are
/// doubled.
std::string csv_line(const CsvRecord& cells);

/// The records of a text.
struct CsvRecords {
  std::vector<CsvRecord> records;
  std::vector<std::size_t> lines;  ///< of each record, the number of its first line, from 1
  std::size_t whole_bytes = 0;  ///< up to the end of the last complete record; a writer that crashed may leave a rest
};

/// Parses records that end with LF or CR LF. Text after the last line end is a rest, not a record. Nothing is refused:
/// a quote inside a cell that does not start with one is an ordinary character.
CsvRecords parse_csv(std::string_view text);

}  // namespace tern
