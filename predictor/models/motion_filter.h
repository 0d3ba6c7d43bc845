// A Kalman filter of one motion model on the three axes of W, in memory that is somebody else's (model_bank.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/base/types.h"
#include "predictor/models/axis_filter.h"
#include "predictor/models/motion_model.h"

namespace tern {

/// The rows of a step that positions and velocities ahead need: p = φ s, var p = φ P φᵀ + q.
struct OutputRows {
  ModelVector position;   ///< φ
  ModelVector velocity;   ///< the same for s_1
  double variance = 0.0;  ///< q, m²
};
OutputRows output_rows(const ModelStep& step);
/// Of `ahead` after `first`.
OutputRows output_rows(const ModelStep& ahead, const ModelStep& first);

/// What a filter says of some time ahead, per axis.
struct FilterPrediction {
  Vec3 position, velocity;  ///< m, m/s
  Vec3 variance;            ///< of the position, m²
};

/// States of three axes that share a model. While sensors give all axes one variance, so does the covariance.
///
/// @tparam Number  double, or const double to look only
template <typename Number>
struct FilterStates {
  int order = 0;
  Number* mean = nullptr;               ///< order × 3, an axis per column
  std::array<Number*, 3> covariance{};  ///< of each axis, order × order; the same one while all are alike
};

/// A filter's answers.
class MotionFilter {
 public:
  explicit MotionFilter(const FilterStates<const double>& states) : states_(states) {}

  [[nodiscard]] Vec3 position() const { return state(0); }
  [[nodiscard]] Vec3 velocity() const { return state(1); }
  [[nodiscard]] Vec3 variance() const;                ///< of the position, m²
  [[nodiscard]] AxisFilter marginal(int axis) const;  ///< position and velocity alone
  [[nodiscard]] FilterPrediction at(const OutputRows& ahead) const;
  /// All states of an axis.
  [[nodiscard]] const double* mean(int axis) const {
    return states_.mean + static_cast<std::ptrdiff_t>(states_.order) * axis;
  }

 private:
  [[nodiscard]] Vec3 state(int row) const {
    const int n = states_.order;
    return Vec3(states_.mean[row], states_.mean[n + row], states_.mean[2 * n + row]);
  }
  FilterStates<const double> states_;
};

/// Begins with the first measurement: z (m) with variances r (m²; taken as kLeastVariance if less).
void start(const MotionModel& model, const Vec3& z, const Vec3& r, const FilterStates<double>& states);
void predict(const ModelStep& step, const FilterStates<double>& states);
/// @pre covariances of the axes are apart if r differs between them
void update(const Vec3& z, const Vec3& r, const FilterStates<double>& states);

}  // namespace tern
