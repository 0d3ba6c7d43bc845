// The motion models that all tracks are predicted with, and one track's filters of them.
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

/// A coarse grid over how long motion lasts and how fast it is: from what walks on to what swings, a factor of 1.4 to 4
/// apart. Which of them a track follows, and at which horizon, its weights say (model_scores.h): none is fitted to a
/// world.
const PerModel<MotionModel>& motion_models();
/// Their orders.
inline constexpr PerModel<int> kOrders{2, 2, 3, 4, 7, 7, 7, 2, 3, 4, 4, 7, 7, 7, 7};
/// The first so many are steady (calm constant velocities), the next ones up to the second number calm (they accelerate
/// slowly), the others lively.
inline constexpr std::size_t kSteadyModels = 2, kCalmModels = 7;
/// This one is a constant velocity of any size: nothing else is known of what was seen once.
inline constexpr std::size_t kWidestModel = 7;

using BankStep = PerModel<ModelStep>;
BankStep bank_step(double dt);
using BankOutputRows = PerModel<OutputRows>;
/// `ahead` after `first`.
BankOutputRows bank_output_rows(const BankStep& ahead, const BankStep& first);

/// One track's filters. Their evidence (the likelihood of one step, forgotten over some 20 detections) serves
/// association alone: which detection is a track's. It is no judge of predictions.
class BankFilter {
 public:
  BankFilter() = default;
  BankFilter(const Vec3& z, const Vec3& r);

  void predict(const BankStep& step);
  void update(const Vec3& z, const Vec3& r);
  /// Σ over axes of (z − x)²/S, by the model of the most evidence or the widest, whichever is nearer: χ² of three
  /// degrees of freedom where it holds.
  [[nodiscard]] double distance2(const Vec3& z, const Vec3& r) const;
  /// How unlikely the detection is: the less of the two models' surprise() that are nearer than the gate.
  /// @return infinite if neither is
  [[nodiscard]] double cost_within(double gate, const Vec3& z, const Vec3& r) const;
  /// A box that holds all detections of at most the variance r whose surprise_within() is finite.
  [[nodiscard]] Box gate_box(double gate, const Vec3& r) const;
  [[nodiscard]] MotionFilter of(std::size_t model) const;
  /// The model of the most evidence.
  [[nodiscard]] std::size_t leading() const { return lead_; }
  [[nodiscard]] MotionFilter lead() const { return of(leading()); }

 private:
  static constexpr int kMeans = 3 * std::accumulate(kOrders.begin(), kOrders.end(), 0);
  static constexpr int kCovariances = std::inner_product(kOrders.begin(), kOrders.end(), kOrders.begin(), 0);
  template <typename Number, typename Bank>
  static FilterStates<Number> states(Bank& bank, std::size_t model);
  /// Whether one axis alone is beyond the gate: most pairs of a track and a detection are, and cost no more than that.
  [[nodiscard]] bool is_beyond(std::size_t model, double gate, const Vec3& z, const Vec3& r) const;
  /// Gives each axis a covariance of its own, where they begin to differ.
  void separate_axes(const Vec3& r);

  std::array<double, kMeans> means_{};              // of one model after the other
  std::array<double, kCovariances> covariances_{};  // of the first axis
  std::vector<double> others_;                      // of the two others; empty while all are alike
  PerModel<double> evidence_{};
  std::size_t lead_ = 0;
};

}  // namespace tern
