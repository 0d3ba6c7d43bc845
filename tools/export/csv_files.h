// Writes messages as CSV tables: a file per channel, and a file per list within its messages.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "core/base/result.h"
#include "tools/export/logged_messages.h"
#include "tools/export/output_files.h"

namespace tern::exporting {

/// Writes CSV files (RFC 4180 with '\n').
///
/// - CHANNEL.csv has a row per message. Columns: `message` (row number, from 0), `received_us`, then the fields. Nested
///   fields are joined by dots, elements of a fixed array by their index: "motion.position.x [m]", "stage_ms.3".
/// - CHANNEL.LIST.csv has a row per element of a list. Columns: `message` (the row number of its message), `index`,
///   then the element's fields.
///
/// The header row names the unit unless the field's name does. Numbers read back to the same double, "nan" and "inf"
/// included.
class CsvFiles {
 public:
  /// A file is begun in `folder` with the first message of its channel.
  /// @param outputs  gives the files their names; it outlives this
  CsvFiles(std::filesystem::path folder, OutputFiles& outputs) : folder_(std::move(folder)), outputs_(outputs) {}
  void add(const LoggedMessage& message);
  /// Closes all files. @return an Error that names the first file that could not be written
  Result<void> finish();

 private:
  struct Table {
    std::ofstream file;
    std::int64_t rows = 0;
  };
  Table& table(const std::string& name, const std::string& head);

  std::filesystem::path folder_;
  OutputFiles& outputs_;
  std::map<std::string, Table> tables_;
};

}  // namespace tern::exporting
