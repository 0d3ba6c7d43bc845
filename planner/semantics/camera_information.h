// The information of a stereo camera about its motion, from the landmarks that it is expected to see.
#pragma once

#include "core/base/types.h"

namespace tern {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// The camera that labels are judged for: level, looking along the heading. A camera of other dimensions sees more or
/// less by a factor that is nearly the same everywhere.
struct TextureCamera {
  double view_rad = 1.4835;        ///< horizontal field of view: 85°
  double half_height_rad = 0.480;  ///< half of the vertical one: 480 of 848 pixels
  double focal_px = 462.7;
  double baseline_m = 0.11;
  double range_m = 25.0;
  double grazing_rad = 0.1396;  ///< 8°: flatter surfaces are not recognized
  double frame_s = 0.05;
  double most_tracks = 150.0;
};

/// The information about (rotation, translation) between two frames, and the expected number of landmarks behind it.
struct ViewInformation {
  Mat6 information = Mat6::Zero();  ///< 1/rad², 1/m², axes of W, about the camera
  double landmarks = 0.0;

  /// Adds `count` landmarks at this displacement from the camera.
  /// A landmark lies in direction u at distance r. A pair of frames measures its bearing with σ = √2/f rad, and its
  /// distance by disparity with σ = 2 r²/(f b) m. With δx = t + θ × x:
  ///
  ///     I += n f²/(2 r²) Aᵀ(1 − uuᵀ)A + n (f b / (2 r²))² Aᵀuuᵀ A,   A = [−[x]×  1]
  void add(const Vec3& displacement, double count, const TextureCamera& camera);
  ViewInformation& operator+=(const ViewInformation& other);
};

/// Standard deviations of what a pair of frames measures.
struct FrameSigma {
  double translation_m = 0.0;  ///< √tr C_tt, with the gyroscope's help
  double rotation_rad = 0.0;   ///< √(tr C_θθ / 3), by landmarks alone
};

/// Returns the deviations that a view leaves. The gyroscope adds 1/(g_n² Δt) on rotation: without it fewer than three
/// landmarks would give nothing. At most camera.most_tracks landmarks count. With n expected ones, the view counts for
/// the share of the time in which at least three are there: 1 − e⁻ⁿ(1 + n + n²/2). The rest is dark.
FrameSigma frame_sigma(const ViewInformation& view, const TextureCamera& camera);

}  // namespace tern
