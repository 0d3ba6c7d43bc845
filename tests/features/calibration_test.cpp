// Calibrations of EuRoC and Kalibr give the same rig; mistakes are named with file and key.
#include "features/app/calibration.h"

#include <gtest/gtest.h>

#include <functional>

#include "runtime/config.h"
#include "tests/features/recording_files.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

constexpr const char* kKalibr = R"(cam0:
  T_cam_imu:
  - [0.0, 1.0, 0.0, 0.055]
  - [-1.0, 0.0, 0.0, -0.02]
  - [0.0, 0.0, 1.0, -0.01]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [0.01, 0.002, -0.003, 0.0004]
  distortion_model: equidistant
  intrinsics: [229.0, 229.0, 187.5, 119.5]
  resolution: [376, 240]
  rostopic: /cam0/image_raw
  timeshift_cam_imu: -0.0042
cam1:
  T_cam_imu:
  - [0.0, 1.0, 0.0, -0.055]
  - [-1.0, 0.0, 0.0, -0.02]
  - [0.0, 0.0, 1.0, -0.01]
  - [0.0, 0.0, 0.0, 1.0]
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [0.01, 0.002, -0.003, 0.0004]
  distortion_model: equidistant
  intrinsics: [229.0, 229.0, 187.5, 119.5]
  resolution: [376, 240]
)";

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "nothing was refused";
}

/// Forward, left, up.
void expect_forward_pair(const StereoCalibration& calibration) {
  const StereoRig& rig = calibration.rig;
  EXPECT_NEAR(rig.baseline(), 0.11, 1e-9);
  EXPECT_LT((rig.left().p_BC - Vec3(0.01, 0.055, -0.02)).norm(), 1e-6);
  EXPECT_LT((rig.R_BC().col(2) - Vec3(1, 0, 0)).norm(), 1e-6) << "z looks forward";
  EXPECT_LT((rig.R_BC().col(0) - Vec3(0, -1, 0)).norm(), 1e-6) << "x points to the right";
}

TEST(Calibration, ReadsBothFormats) {
  const TempFolder folder;
  support::write_text(folder.file("mav0/cam0/sensor.yaml"), support::euroc_sensor_yaml(-0.055));
  support::write_text(folder.file("mav0/cam1/sensor.yaml"), support::euroc_sensor_yaml(0.055));
  support::write_text(folder.file("chain.yaml"), kKalibr);
  const Eigen::Matrix3d R_BI = body_from_imu("z -y x");
  const StereoCalibration euroc = read_euroc_calibration(folder.file("mav0"), R_BI);
  expect_forward_pair(euroc);
  EXPECT_EQ(euroc.rig.left().model.lens, LensModel::RadialTangential);
  EXPECT_EQ(euroc.rig.left().model.coefficients[3], 1.76e-05);
  EXPECT_EQ(euroc.time_shift_s, 0.0);
  const StereoCalibration kalibr = read_kalibr_calibration(folder.file("chain.yaml"), R_BI);
  expect_forward_pair(kalibr);
  EXPECT_EQ(kalibr.rig.right().model.lens, LensModel::Equidistant);
  EXPECT_EQ(kalibr.time_shift_s, -0.0042);
}

TEST(Calibration, AxesOfTheBodyAreARightHandedFrame) {
  EXPECT_EQ(body_from_imu("x y z"), Eigen::Matrix3d::Identity());
  EXPECT_EQ(body_from_imu("z -y x") * Vec3(9.8, 1.0, 2.0), Vec3(2.0, -1.0, 9.8)) << "EuRoC: x is up";
  for (const char* bad : {"", "x y", "x y z x", "x x y", "z y x", "x y -", "x y zz", "forward left up"}) {
    EXPECT_NE(refusal([&] { body_from_imu(bad); }).find("right-handed"), std::string::npos) << bad;
  }
}

TEST(Calibration, MistakesAreNamedWithFileAndKey) {
  const TempFolder folder;
  const std::string file = folder.file("chain.yaml");
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string text = kKalibr;
    text.replace(text.find(from), from.size(), to);
    support::write_text(file, text);
    return refusal([&] { read_kalibr_calibration(file, Eigen::Matrix3d::Identity()); });
  };
  const std::pair<std::pair<const char*, const char*>, const char*> cases[] = {
      {{"T_cam_imu", "T_other"}, "T_cam_imu is missing"},
      {{"cam1:", "cam2:"}, "cam1 is missing"},
      {{"[0.0, 1.0, 0.0, 0.055]", "[0.0, 2.0, 0.0, 0.055]"}, "no rotation"},
      {{"[0.0, 1.0, 0.0, 0.055]", "[0.0, 1.0, 0.055]"}, "T_cam_imu has 15 numbers, not 16"},
      {{"[0.0, 1.0, 0.0, 0.055]", "[0.0, one, 0.0, 0.055]"}, "one is no number"},
      {{"pinhole", "omni"}, "camera_model: omni is not supported"},
      {{"equidistant", "fov"}, "distortion_model: fov is not supported"},
      {{"[376, 240]", "[376, -240]"}, "resolution is out of range"},
      {{"[229.0, 229.0", "[229.0, -229.0"}, "intrinsics"},
      {{"-0.0042", "-42"}, "timeshift_cam_imu is out of range"},
      {{"0.055]", "-0.3]"}, "exchanged"},
  };
  for (const auto& [change, expected] : cases) {
    EXPECT_NE(refused(change.first, change.second).find(expected), std::string::npos)
        << expected << ": " << refused(change.first, change.second);
  }
  EXPECT_NE(refusal([&] {
              read_euroc_calibration(folder.file("none"), Eigen::Matrix3d::Identity());
            }).find("cam0/sensor.yaml: cannot be read"),
            std::string::npos);
}

}  // namespace
}  // namespace tern
