// tern-calibrate: compares predictions with recorded or synthetic truth, and makes the prior of the calibration.
#pragma once

#include <string>
#include <vector>

namespace tern::calibrate {

struct CalibrationRequest {
  std::vector<std::string> logs;  ///< files, or folders that hold flight.lcm
  int synthetic = 0;              ///< synthetic recordings of each kind of motion
  std::string csv;                ///< file for a copy of the coverage table; "": none
  std::string prior;              ///< file for the prior made from all recordings; "": none
};

/// Predicts the obstacles of all recordings anew from their detections, and prints the coverage table.
/// @throws std::runtime_error for an unreadable log, an unwritable file, or too few recordings for a prior
void calibrate(const CalibrationRequest& request);

}  // namespace tern::calibrate
