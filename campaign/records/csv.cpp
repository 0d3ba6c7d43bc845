#include "campaign/records/csv.h"

#include <utility>

namespace tern {
namespace {

std::string quoted(const std::string& cell) {
  std::string out = "\"";
  for (const char c : cell) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace

std::string csv_line(const CsvRecord& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += ',';
    line += cells[k].find_first_of(",\"\r\n") == std::string::npos ? cells[k] : quoted(cells[k]);
  }
  return line + '\n';
}

CsvRecords parse_csv(std::string_view text) {
  CsvRecords out;
  CsvRecord record;
  std::string cell;
  bool in_quotes = false, was_quoted = false;
  std::size_t line = 1, begin_line = 1;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    line += c == '\n' ? 1 : 0;
    if (in_quotes) {
      const bool doubled = c == '"' && k + 1 < text.size() && text[k + 1] == '"';
      if (c != '"' || doubled) cell += c;
      if (doubled) ++k;
      if (c == '"' && !doubled) in_quotes = false;
    } else if (c == '"' && cell.empty() && !was_quoted) {
      in_quotes = was_quoted = true;
    } else if (c == ',' || c == '\n') {
      if (c == '\n' && !was_quoted && cell.ends_with('\r')) cell.pop_back();
      record.push_back(std::exchange(cell, {}));
      was_quoted = false;
      if (c == ',') continue;
      out.records.push_back(std::exchange(record, {}));
      out.lines.push_back(std::exchange(begin_line, line));
      out.whole_bytes = k + 1;
    } else if (c != '\r' || !was_quoted) {
      cell += c;
    }
  }
  return out;
}

}  // namespace tern
