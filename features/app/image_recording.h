// A recorded sequence in the layout of EuRoC (ASL): lists of stereo images and IMU samples, by time.
#pragma once

#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/world/inertial.h"

namespace tern {

/// Two images of one time, by their files.
struct RecordedPair {
  UTime at;  ///< as recorded: the middle of the exposure
  std::string left, right;
};

struct ImageRecording {
  std::vector<RecordedPair> pairs;  ///< in the order of the left camera's list
  std::vector<ImuSample> samples;   ///< in the IMU's frame, in ascending order of time; means of two neighbours
  int unpaired = 0;                 ///< left images without a right one within kPairWithin
};
inline constexpr Duration kPairWithin{1'000};

/// Returns the folder mav0: in `folder`, or `folder` itself.
std::string mav0_of(const std::string& folder);

/// Reads mav0/cam0/data.csv, cam1/data.csv and, with_imu, imu0/data.csv: ns, rates (rad/s), specific forces (m/s²).
/// These hold single values; samples are the means that tern-estimator expects.
/// @throws ConfigError that names file and line, if a list cannot be read, or a sample is older than the one before it.
ImageRecording read_image_recording(const std::string& mav0, bool with_imu);

}  // namespace tern
