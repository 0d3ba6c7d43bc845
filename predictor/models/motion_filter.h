// A Kalman filter of one motion model on the three axes of W.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/types.h"
#include "predictor/models/axis_filter.h"
#include "predictor/models/motion_model.h"

namespace tern {

/// The rows of a step that positions and velocities ahead need: p = φ s, var p = φ P φᵀ + q.
struct ModelLook {
  ModelVector position;   ///< φ
  ModelVector velocity;   ///< the same for s_1
  double variance = 0.0;  ///< q, m²
};
ModelLook look(const ModelStep& step);
/// Of `ahead` after `first`.
ModelLook look(const ModelStep& ahead, const ModelStep& first);

/// States of three axes that share a model. While sensors give all axes one variance, so does the covariance.
class MotionFilter {
 public:
  MotionFilter() = default;
  /// From the first measurement: z (m) with variances r (m²; taken as kLeastVariance if less).
  MotionFilter(const MotionModel& model, const Vec3& z, const Vec3& r);

  void predict(const ModelStep& step);
  void update(const Vec3& z, const Vec3& r);
  [[nodiscard]] Vec3 position() const { return mean_.row(0).transpose(); }
  [[nodiscard]] Vec3 velocity() const { return mean_.row(1).transpose(); }
  [[nodiscard]] Vec3 variance() const;                ///< of the position, m²
  [[nodiscard]] AxisFilter marginal(int axis) const;  ///< position and velocity alone
  [[nodiscard]] Vec3 position_at(const ModelLook& ahead) const;
  [[nodiscard]] Vec3 velocity_at(const ModelLook& ahead) const;
  [[nodiscard]] Vec3 variance_at(const ModelLook& ahead) const;

 private:
  [[nodiscard]] const ModelMatrix& covariance(int axis) const {
    return axis == 0 || others_.empty() ? first_ : others_[static_cast<std::size_t>(axis - 1)];
  }
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxOrder, 3> mean_;
  ModelMatrix first_;                // covariance of the first axis
  std::vector<ModelMatrix> others_;  // of the two others; empty while all are alike
};

}  // namespace tern
