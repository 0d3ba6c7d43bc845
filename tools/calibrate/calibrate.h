// What tern-calibrate does: holds predictions against what came, and makes the table that calibration begins with.
#pragma once

#include <string>
#include <vector>

namespace tern::calibrate {

struct CalibrationRequest {
  std::vector<std::string> logs;  ///< files, or folders of flight.lcm
  int made_up = 0;                ///< recordings of made-up movers of each kind
  std::string csv;                ///< the coverage table goes there, too; "": nowhere
  std::string prior;              ///< the table that calibration begins with, of these logs; "": not made
};

/// Prints the coverage table. @throws std::runtime_error for a log that cannot be read or a file not written.
void calibrate(const CalibrationRequest& request);

}  // namespace tern::calibrate
