// Small recordings in EuRoC's layout, rendered.
#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "features/gray_image.h"

namespace tern::support {

inline void write_text(const std::string& file, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  std::ofstream(file) << text;
}

inline void write_image(const std::string& file, const GrayImage& image) {
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  const cv::Mat mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::imwrite(file, mat);
}

/// EuRoC's cam0/sensor.yaml. @param y_offset  of the camera in the IMU's frame (x up, y right, z forward), m
inline std::string euroc_sensor_yaml(double y_offset, int width = 752, int height = 480) {
  return "%YAML:1.0\n# General sensor definitions.\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
         "  data: [0.0, -1.0, 0.0, -0.02,\n         1.0, 0.0, 0.0, " +
         std::to_string(y_offset) +
         ",\n         0.0, 0.0, 1.0, 0.01,\n         0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [" +
         std::to_string(width) + ", " + std::to_string(height) +
         "]\ncamera_model: pinhole\nintrinsics: [229.0, 229.0, 187.5, 119.5] #fu, fv, cu, cv\n"
         "distortion_model: radial-tangential\ndistortion_coefficients: [-0.28, 0.07, 0.0002, 1.76e-05]\n";
}

}  // namespace tern::support
