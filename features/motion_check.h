// Which features move as the surroundings do: RANSAC over the motion of the stereo pair between two frames.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.h"

namespace tern {

/// A feature in two frames.
struct MovedPoint {
  Vec3 before = Vec3::Zero();                     ///< in C of the first frame: its position, m, or only its direction
  Eigen::Vector2d now = Eigen::Vector2d::Zero();  ///< x/z, y/z in C of the second frame
  bool has_depth = false;                         ///< `before` is a position
  double weight = 1.0;                            ///< its votes, > 0
};

/// Returns for each point whether the motion of the camera that most votes agree with explains it. nullopt if fewer
/// than kLeastAgreeing points with a depth, or less than half of their votes, agree with one motion: then nothing is
/// known.
///
/// 1. kHypotheses times, three points with a depth are drawn. Gauss-Newton steps from no motion find the motion that
///    explains them. (Between frames the camera turns by less than half a radian.)
/// 2. The motion that most votes agree with is refined over these points.
/// 3. A point agrees if its projection is at most kTolerance·σ·√(1 + (t/b)²) from where it is seen. t is the length of
///    the motion and b the baseline: by the motion an error of the disparity appears t/b times in the image. A point
///    without a depth may be anywhere along its direction: the nearest of its projections counts.
///
/// The essential matrix needs no stereo, but is undetermined when the camera only turns. Deterministic: the draws begin
/// with the same seed each time.
/// @param sigma  standard deviation of a normalized coordinate  @param baseline  m
std::optional<std::vector<bool>> agree_with_motion(const std::vector<MovedPoint>& points, double sigma,
                                                   double baseline);
inline constexpr int kHypotheses = 50;
inline constexpr int kLeastAgreeing = 8;
inline constexpr double kTolerance = 1.0;

}  // namespace tern
