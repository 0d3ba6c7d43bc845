// Rendered flights: the images of a stereo pair and the IMU along a known motion, and what tracks should have been.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "core/world/inertial.h"
#include "estimator/filter/motion.h"
#include "features/gray_image.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/vio_flight.h"

namespace tern::support {

/// In circles of 3.5 m about the middle of the hall, looking ahead, up and down by 0.4 m.
VioPath circling(double seconds, double speed = 2.5);

/// A hall with a box in its middle. The second box, if there is one, moves in circles as well.
SceneGeometry hall_with_box(bool has_mover = false);

struct ImagePair {
  GrayImage left, right;
};

/// The cameras of a rig in a scene.
class SceneRig {
 public:
  SceneRig(const StereoRig& rig, SceneGeometry scene);
  [[nodiscard]] ImagePair see(double t, const NavState& truth, const Lighting& lighting = {}) const;
  /// The same, blurred: the mean of the images at these states.
  [[nodiscard]] ImagePair blurred(double t, const std::vector<NavState>& states) const;
  [[nodiscard]] const StereoRig& rig() const { return rig_; }
  [[nodiscard]] const SceneGeometry& scene() const { return scene_; }

 private:
  StereoRig rig_;
  SceneGeometry scene_;
  SceneCamera left_, right_;
};

/// Compares tracks with the projections of the points on which they began.
class TrackJudge {
 public:
  /// Errors are judged over this many frames of a track: the estimator uses a track over so many.
  static constexpr int kFrames = 11;
  static constexpr double kOutlierPx = 4.0;

  explicit TrackJudge(const SceneRig& rig) : rig_(rig) {}
  void judge(double t, const NavState& truth, const FeatureFrame& frame);

  std::vector<double> left, right;  ///< magnitudes of the errors of single coordinates, pixels
  int views = 0, outliers = 0;      ///< of the left images
  int with_right = 0;
  int on_mover = 0;  ///< views of the second box by tracks of three frames or more
  int features = 0;
  std::map<std::int64_t, int> ages;

 private:
  struct Birth {
    SurfaceHit hit;
    double t = 0.0;
  };
  const SceneRig& rig_;
  std::map<std::int64_t, Birth> births_;
};

/// Returns a quantile. @pre values is not empty
double quantile(std::vector<double> values, double share);

}  // namespace tern::support
