// One pass through a log, into everything that was asked for.
#pragma once

#include <string>

#include "core/base/result.h"

namespace tern::exporting {

struct ExportOptions {
  std::string log;         ///< a file, or the folder of flight.lcm
  std::string csv_folder;  ///< made where it is missing; empty: no tables
  std::string mcap_file;   ///< empty: none
  std::string suffix;      ///< what the vehicle's channels end with
};

/// @return what was written and what the log did not give, for people. An Error when nothing was asked for, the log
/// cannot be opened or holds no message of Tern's, or something cannot be written.
Result<std::string> export_log(const ExportOptions& options);

}  // namespace tern::exporting
