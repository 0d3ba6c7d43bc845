// Calibrations of a stereo pair, as EuRoC and Kalibr write them.
#pragma once

#include <string>

#include "features/stereo_rig.h"

namespace tern {

/// A calibrated pair, and how its times compare with the IMU's.
struct StereoCalibration {
  StereoRig rig;
  double time_shift_s = 0.0;  ///< IMU's time minus the images' time
};

/// Returns the rotation from the IMU to the body B. `axes` names the body's forward, left and up as axes of the IMU.
/// @throws ConfigError unless these are three different axes of a right-handed frame, such as "z -y x".
Eigen::Matrix3d body_from_imu(const std::string& axes);

/// Reads cam0/sensor.yaml and cam1/sensor.yaml in EuRoC's folder mav0. Their T_BS lead from the camera to the IMU.
/// @throws ConfigError that names file, key and what is wrong.
StereoCalibration read_euroc_calibration(const std::string& mav0, const Eigen::Matrix3d& R_BI);

/// Reads a camera chain of Kalibr, cam0 (left) and cam1: T_cam_imu leads from the IMU to the camera, T_cn_cnm1 from
/// cam0 to cam1.
/// @throws ConfigError that names file, key and what is wrong.
StereoCalibration read_kalibr_calibration(const std::string& file, const Eigen::Matrix3d& R_BI);

}  // namespace tern
