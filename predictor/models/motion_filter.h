// A Kalman filter of one motion model on the three axes of W. Its memory belongs to the bank (model_bank.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/base/types.h"
#include "predictor/models/axis_filter.h"
#include "predictor/models/motion_model.h"

namespace tern {

/// The rows of a step that a prediction of position and velocity needs: p = φ s, var p = φ P φᵀ + q.
struct OutputRows {
  ModelVector position;   ///< φ
  ModelVector velocity;   ///< the row of s_1
  double variance = 0.0;  ///< q, m²
};
OutputRows output_rows(const ModelStep& step);
/// The rows for the step `first` followed by the step `ahead`.
OutputRows output_rows(const ModelStep& ahead, const ModelStep& first);

/// A prediction for one time ahead, per axis of W.
struct FilterPrediction {
  Vec3 position, velocity;  ///< m, m/s
  Vec3 variance;            ///< of the position, m²
};

/// The states of three axes that share a model. While all measurements have one variance on all axes, the axes also
/// share one covariance.
///
/// @tparam Number  double, or const double for reading
template <typename Number>
struct FilterStates {
  int order = 0;
  Number* mean = nullptr;               ///< order × 3, an axis per column
  std::array<Number*, 3> covariance{};  ///< of each axis, order × order; equal pointers while they are shared
};

/// Reads the states of a filter.
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

/// Initializes the states from the first measurement: z (m) with variances r (m², raised to kMinVariance if less).
void start(const MotionModel& model, const Vec3& z, const Vec3& r, const FilterStates<double>& states);
void predict(const ModelStep& step, const FilterStates<double>& states);
/// @pre each axis has its own covariance if r differs between the axes
void update(const Vec3& z, const Vec3& r, const FilterStates<double>& states);

}  // namespace tern
