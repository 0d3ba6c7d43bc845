// A stereo camera in a world of boxes: projection, field of view, range, grazing angle, blur, occlusion.
#pragma once

#include <optional>
#include <vector>

#include "core/base/knobs.h"
#include "core/base/types.h"
#include "simulator/inertial/strapdown.h"

namespace tern {

/// The section `simulator.vio.camera`: two equal pinhole cameras without distortion, side by side. The image's centre
/// is the principal point, pixels are square. Both look along the body's forward axis, turned down by `pitch_down`. The
/// left one is at the body's position.
struct StereoSpec {
  double rate_hz = 20.0;
  int width = 848, height = 480;
  double fov_deg = 85.0;
  double baseline_m = 0.11;
  double pitch_down_deg = 0.0;
  double range_m = 25.0;
  double grazing_deg = 8.0;
  double blur_px_s = 2000.0;
  template <typename V>
  void visit(V& v) {
    v("rate_hz", rate_hz, Range{1.0, 50.0}, "frames per second; the period is rounded to whole 5 ms");
    v("width", width, Range{64, 8192}, "pixels per row");
    v("height", height, Range{64, 8192}, "pixels per column");
    v("fov_deg", fov_deg, Range{20.0, 150.0}, "horizontal field of view, degrees");
    v("baseline_m", baseline_m, Range{0.01, 2.0}, "distance of the right camera from the left one, m");
    v("pitch_down_deg", pitch_down_deg, Range{-90.0, 90.0}, "how far the cameras look below the forward axis, degrees");
    v("range_m", range_m, Range{1.0, 1000.0}, "landmarks farther than this are not recognized, m");
    v("grazing_deg", grazing_deg, Range{0.0, 60.0},
      "landmarks on a surface that is seen at a smaller angle than this are not recognized, degrees");
    v("blur_px_s", blur_px_s, Range{1.0, 1e5},
      "landmarks that move faster than this in the image are blurred, pixels/s");
  }
  /// Returns the focal length, pixels: width/2 / tan(fov/2).
  [[nodiscard]] double focal_px() const;
  /// Returns the rotation from the camera C (right, down, forward) to B.
  [[nodiscard]] Mat3 camera_to_body() const;
};

/// A point on a surface.
struct SurfacePoint {
  Vec3 p = Vec3::Zero();       ///< W, m
  Vec3 v = Vec3::Zero();       ///< of the surface, W, m/s
  Vec3 normal = Vec3::Zero();  ///< unit, outwards, W; zero: seen under every angle
  bool two_sided = false;      ///< seen from both sides
  bool far = false;            ///< on the horizon: seen beyond the range
};

/// Where a point is in both images.
struct StereoPixel {
  Eigen::Vector2d left = Eigen::Vector2d::Zero();  ///< u to the right, v down, pixels
  double disparity = 0.0;                          ///< u_left − u_right, pixels, > 0
  bool in_right = false;                           ///< the right image contains it
};

/// One exposure: the body's true motion at its time, and the boxes that hide what is behind them.
class CameraFrame {
 public:
  /// @param rate  body rates, rad/s  @param boxes  all obstacles at that time, W
  CameraFrame(const StereoSpec& spec, const InertialState& body, const Vec3& rate, const std::vector<Box>& boxes);

  /// Returns the pixel of a point that is in front of the left camera and in its image; nullopt for any other.
  [[nodiscard]] std::optional<StereoPixel> project(const Vec3& p_W) const;
  /// Returns the pixel of a point if it is projected, in range, seen at a large enough angle, and not blurred.
  [[nodiscard]] std::optional<StereoPixel> see(const SurfacePoint& point) const;
  /// Whether a box lies between the left camera and the point. A box hides nothing within kSkin of its surface.
  [[nodiscard]] bool hides(const SurfacePoint& point) const;
  [[nodiscard]] const Vec3& eye() const { return body_.p; }

  static constexpr double kSkin = 1e-3;  ///< m: rounding of points that lie on a box

 private:
  [[nodiscard]] double image_speed(const Vec3& p_C, const Vec3& v_W) const;
  StereoSpec spec_;
  double focal_, sin_grazing_;
  InertialState body_;
  Mat3 to_camera_;
  Vec3 rate_in_world_;
  std::vector<Box> near_;  ///< boxes within range
};

}  // namespace tern
