// The bank of motion models, and the Kalman filters of one track: one per model.
#pragma once

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/base/types.h"
#include "predictor/models/motion_filter.h"
#include "predictor/models/motion_model.h"

namespace tern {

inline constexpr std::size_t kModels = 15;
template <typename T>
using PerModel = std::array<T, kModels>;

/// A coarse grid over time scales and speeds, from steady walking to swinging, with steps of a factor 1.4 to 4. No
/// model is fitted to a scene. The weights of a track (model_scores.h) choose among them, per horizon.
const PerModel<MotionModel>& motion_models();
/// The models' orders (MotionModel::order).
inline constexpr PerModel<int> kOrders{2, 2, 3, 4, 7, 7, 7, 2, 3, 4, 4, 7, 7, 7, 7};
/// Models below the first index are steady (constant velocity with little noise). Those below the second are calm (slow
/// accelerations). The rest are lively.
inline constexpr std::size_t kSteadyModels = 2, kCalmModels = 7;
/// A constant velocity with a wide prior. It leads for a track that was detected once.
inline constexpr std::size_t kWidestModel = 7;

using BankStep = PerModel<ModelStep>;
BankStep bank_step(double dt);
using BankOutputRows = PerModel<OutputRows>;
/// The rows for the step `first` followed by the step `ahead`.
BankOutputRows bank_output_rows(const BankStep& ahead, const BankStep& first);

/// One track's filters. Each has an evidence: its log likelihood of the detections, with a memory of some 20 of them.
/// Evidence serves the matching of detections only; predictions are weighed by ModelScores.
class BankFilter {
 public:
  BankFilter() = default;
  BankFilter(const Vec3& z, const Vec3& r);

  void predict(const BankStep& step);
  void update(const Vec3& z, const Vec3& r);
  /// Starts one axis anew from a position z (m) with the variance r (m²); the other axes keep their states.
  void restart_axis(int axis, double z, double r);
  /// Returns Fit::distance2 by the leading model or by kWidestModel, whichever is less.
  [[nodiscard]] double distance2(const Vec3& z, const Vec3& r) const;
  /// Returns the lesser Fit::neg_log_likelihood() of the leading model and kWidestModel, among those whose distance2 is
  /// within the gate. Infinite if neither is.
  [[nodiscard]] double cost_within(double gate, const Vec3& z, const Vec3& r) const;
  /// Returns a box that contains every detection with a variance of at most r whose cost_within() is finite.
  [[nodiscard]] Box gate_box(double gate, const Vec3& r) const;
  [[nodiscard]] MotionFilter of(std::size_t model) const;
  /// The index of the model with the most evidence.
  [[nodiscard]] std::size_t leading() const { return lead_; }
  [[nodiscard]] MotionFilter lead() const { return of(leading()); }

 private:
  static constexpr int kMeans = 3 * std::accumulate(kOrders.begin(), kOrders.end(), 0);
  static constexpr int kCovariances = std::inner_product(kOrders.begin(), kOrders.end(), kOrders.begin(), 0);
  template <typename Number, typename Bank>
  static FilterStates<Number> states(Bank& bank, std::size_t model);
  /// True if one axis alone exceeds the gate. It is a fast test, which rejects most pairs of track and detection.
  [[nodiscard]] bool is_beyond(std::size_t model, double gate, const Vec3& z, const Vec3& r) const;
  /// Gives each axis its own covariances from the first r on whose entries differ.
  void separate_axes(const Vec3& r);
  void separate_axes();

  std::array<double, kMeans> means_{};              // of all models, one after the other
  std::array<double, kCovariances> covariances_{};  // of the first axis
  std::vector<double> others_;                      // of the two other axes; empty while all axes are equal
  PerModel<double> evidence_{};
  std::size_t lead_ = 0;
};

}  // namespace tern
