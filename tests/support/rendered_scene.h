// Rendered images of a scene with exactly known geometry: a hall and boxes in it, with textures of all scales.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/types.h"
#include "features/gray_image.h"
#include "features/stereo_rig.h"

namespace tern::support {

/// A box that moves without turning. Its texture moves along.
struct TexturedBox {
  Box at_start;                                                               ///< W, m
  std::function<Vec3(double)> offset = [](double) { return Vec3(0, 0, 0); };  ///< at a time, s; W, m
};

/// The inside of a hall, and boxes.
struct SceneGeometry {
  Box hall{Vec3(-8.0, -7.0, 0.0), Vec3(8.0, 7.0, 4.0)};
  std::vector<TexturedBox> boxes;
};

/// Where a ray first meets a surface.
struct SurfaceHit {
  double distance = 0.0;  ///< along the ray, in its lengths
  int box = -1;           ///< index; −1: the hall
  Vec3 p_W = Vec3::Zero();
};
SurfaceHit cast_ray(const SceneGeometry& scene, double t, const Vec3& from, const Vec3& direction);

struct Lighting {
  double exposure = 1.0;  ///< multiplies all grey values; 0: black
  double noise = 2.0;     ///< standard deviation, grey values
  double contrast = 1.0;  ///< of the textures; 0: bare walls
};

/// Renders images of one camera. Textures are bilinear at two levels of detail chosen by the distance, so a pixel sees
/// about its own area. Deterministic.
class SceneCamera {
 public:
  explicit SceneCamera(const MountedCamera& camera);
  [[nodiscard]] GrayImage render(const SceneGeometry& scene, double t, const Eigen::Matrix3d& R_WB, const Vec3& p_WB,
                                 const Lighting& lighting = {}) const;

 private:
  MountedCamera camera_;
  std::vector<Vec3> rays_;  ///< per pixel, with z = 1; (0, 0, 0) where the lens's model has none
};

/// A pair like that of EuRoC, in a body with x forward: 752×480, 0.11 m, radial-tangential distortion, cameras turned
/// by a degree against each other. @param scale  of the image's size
Result<StereoRig> euroc_like_rig(double scale = 1.0);
/// The same place with equidistant lenses of a wide angle.
Result<StereoRig> fisheye_rig(double scale = 1.0);

}  // namespace tern::support
