// The section `features:` of a scenario.
#pragma once

#include <string>

#include "features/stereo_tracker.h"
#include "runtime/config.h"

namespace tern {

/// Where images come from, and how tracks are made of them.
struct FeaturesConfig {
  std::string recording;            ///< a folder that holds mav0; empty: live cameras
  std::string left, right;          ///< live sources; right empty: side by side in `left`
  std::string calibration;          ///< a file of Kalibr; empty: the recording's own
  std::string body_axes = "x y z";  ///< body_from_imu()
  int sensor = 0;
  bool imu = true;            ///< with a recording
  double from_s = 0.0;        ///< in the recording
  double time_shift_s = 0.0;  ///< added to the times of images
  KltConfig tracks;
};

/// Reads the section, and finishes it. @throws ConfigError for a wrong value.
FeaturesConfig read_features_config(ConfigSection section);

}  // namespace tern
