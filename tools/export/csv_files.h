// Messages as tables: a file per channel, and one per list within its messages.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "core/base/result.h"
#include "tools/export/logged_messages.h"

namespace tern::exporting {

/// CHANNEL.csv has a row per message: `message` (its number in this file, from 0), `received_us`, then its fields,
/// nested ones with dots and those of a fixed array with their index: "motion.position.x [m]", "stage_ms.3". A list has
/// a file of its own, CHANNEL.LIST.csv, with a row per element: `message` (whose it is), `index`, then the element's
/// fields. The header row tells the unit where the name does not. RFC 4180 with '\n'; numbers read back to the same
/// double, "nan" and "inf" included.
class CsvFiles {
 public:
  /// Files appear in `folder` with the first message of their channel; what was there under that name is replaced.
  explicit CsvFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  void add(const LoggedMessage& message);
  /// Closes all. @return an Error that names the first file that could not be written.
  Result<void> finish();

 private:
  struct Table {
    std::ofstream file;
    std::int64_t rows = 0;
  };
  Table& table(const std::string& name, const std::string& head);

  std::filesystem::path folder_;
  std::map<std::string, Table> tables_;
};

}  // namespace tern::exporting
