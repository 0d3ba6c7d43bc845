// One static feature seen by several stereo views: its position, and what its views say about the poses.
#pragma once

#include <optional>
#include <vector>

#include "core/world/inertial.h"

namespace tern {

/// A pose of the left camera, and what the pair measured of the feature from there.
struct PosedView {
  Eigen::Matrix3d R_WC = Eigen::Matrix3d::Identity();
  Vec3 p_WC = Vec3::Zero();  ///< m
  double baseline = 0.0;     ///< m
  double sigma = 1.0;        ///< of a normalized coordinate
  StereoFeature z;
  int pose = 0;  ///< index of the body's pose among those that may be corrected
};

/// Returns the coordinates (x/z, y/z) of a point of the camera's frame. @pre z > 0
inline Eigen::Vector2d projected(const Vec3& x_C) { return {x_C.x() / x_C.z(), x_C.y() / x_C.z()}; }

/// Returns the feature's position with the least sum of squared residuals, W. Points beyond kFarthest are set there.
/// nullopt if the point is not in front of all cameras, or if the views leave it undetermined.
/// @pre views is not empty
std::optional<Vec3> triangulated(const std::vector<PosedView>& views);
inline constexpr double kFarthest = 1e3;  ///< m, from the last view

/// Residuals r = z − ẑ and their derivatives, whitened: each row has the standard deviation 1.
///
///     r = H_x ε + H_f x̃ + n,   H_θ = B [x̂]×,  H_p = −B,  H_f = B,  B = J_π R_CW
///
/// The columns of H_x are (θ, e_p) of pose 0, of pose 1, and so on.
struct FeatureRows {
  Eigen::MatrixXd H_x;  ///< m × 6·poses
  Eigen::Matrix<double, Eigen::Dynamic, 3> H_f;
  Eigen::VectorXd r;
};
/// @param poses  the number of poses; each view's pose is less
FeatureRows feature_rows(const std::vector<PosedView>& views, const Vec3& x_W, int poses);

/// Removes the feature's own error: the rows are projected on the left null space of H_f, which leaves m − 3.
/// @pre m > 3
void eliminate_feature(FeatureRows& rows);

/// Returns a quantile of χ² with `freedom` ≥ 1 degrees of freedom. It is given by the standard normal quantile z of the
/// same probability (1.645: 95 %). Wilson and Hilferty's approximation is within 0.5 % from 3 degrees on.
double chi_square_quantile(int freedom, double z);
inline constexpr double kGate95 = 1.6449, kGate999 = 3.0902, kGate9999 = 3.719;

}  // namespace tern
