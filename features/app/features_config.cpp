#include "features/app/features_config.h"

#include <cstdint>
#include <limits>

namespace tern {

FeaturesConfig read_features_config(ConfigSection section) {
  FeaturesConfig config;
  config.recording = section.text("recording", config.recording,
                                  "folder of a recorded sequence in EuRoC's layout, which holds mav0; empty: live "
                                  "cameras");
  config.left = section.text(
      "left", config.left, "live: number of the left camera's device, or a file, URL or GStreamer pipeline of OpenCV");
  config.right = section.text("right", config.right,
                              "live: the same of the right camera; empty: the images of `left` hold both side by side");
  config.calibration = section.text("calibration", config.calibration,
                                    "camera chain of Kalibr with T_cam_imu; empty: both sensor.yaml of the recording");
  config.body_axes = section.text("body_axes", config.body_axes,
                                  "the body's forward, left and up as axes of the IMU: \"z -y x\" for EuRoC, whose IMU "
                                  "has x up and z forward");
  config.sensor = static_cast<int>(section.integer("sensor", config.sensor, 0, std::numeric_limits<std::int32_t>::max(),
                                                   "`sensor_id` of the published FEATURE_TRACKS and IMU"));
  config.imu = section.flag("imu", config.imu, "also publish the IMU of the recording");
  config.from_s = section.number("from_s", config.from_s, Range{0.0, 1e6},
                                 "where in the recording to begin, s after its first image");
  config.time_shift_s = section.number("time_shift_s", config.time_shift_s, Range::within(1.0),
                                       "middle of the exposure minus the image's stamp, s. The stamp of a live image "
                                       "is its arrival, so this is negative. "
                                       "Kalibr's timeshift_cam_imu is added");
  section.section("tracks").read(config.tracks);
  section.finish();
  return config;
}

}  // namespace tern
