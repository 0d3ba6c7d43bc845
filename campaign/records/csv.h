// Comma-separated values by the book (RFC 4180), but for lines that end with LF alone.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tern {

using CsvRecord = std::vector<std::string>;

/// One record with its line end. Cells with a comma, a quote or a line break are quoted, quotes within doubled.
std::string csv_line(const CsvRecord& cells);

struct CsvRecords {
  std::vector<CsvRecord> records;
  std::vector<std::size_t> lines;  ///< of each record: the line on which it begins, from 1
  std::size_t whole_bytes = 0;     ///< up to the end of the last whole record: a writer that died leaves a rest
};

/// Reads records that end with LF or CR LF; a last one without a line end is a rest, not a record. Nothing is refused:
/// a quote within a cell that does not begin with one stands for itself.
CsvRecords parse_csv(std::string_view text);

}  // namespace tern
