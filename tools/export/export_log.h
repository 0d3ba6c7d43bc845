// Exports a log in one pass.
#pragma once

#include <string>

#include "core/base/result.h"

namespace tern::exporting {

struct ExportOptions {
  std::string log;         ///< a file, or a flight's folder with flight.lcm
  std::string csv_folder;  ///< created if missing; empty: no tables
  std::string mcap_file;   ///< empty: no MCAP file
  std::string bag_folder;  ///< of a rosbag2 recording, created if missing; empty: none. It excludes mcap_file
  std::string suffix;      ///< of the vehicle's channels
};

/// Writes the files that the options name. They take their names when all are complete (OutputFiles).
/// @return text for people: the files written, and the messages that could not be read. Error cases:
/// - the options name no file
/// - the log cannot be opened, or is without a message of Tern
/// - a file to be written is a file of the log
/// - a file cannot be written
Result<std::string> export_log(const ExportOptions& options);

}  // namespace tern::exporting
