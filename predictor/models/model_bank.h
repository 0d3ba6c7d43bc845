// The motion models that all tracks are predicted with, and one track's filters of them.
#pragma once

#include <array>
#include <cstddef>

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
/// The first so many are steady (calm constant velocities), the next ones up to the second number calm (they accelerate
/// slowly), the others lively.
inline constexpr std::size_t kSteadyModels = 2, kCalmModels = 7;
/// This one is a constant velocity of any size: nothing else is known of what was seen once.
inline constexpr std::size_t kWidestModel = 7;

using BankStep = PerModel<ModelStep>;
BankStep bank_step(double dt);
using BankLook = PerModel<ModelLook>;
/// `ahead` after `first`.
BankLook bank_look(const BankStep& ahead, const BankStep& first);

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
  [[nodiscard]] double surprise_within(double gate, const Vec3& z, const Vec3& r) const;
  [[nodiscard]] const MotionFilter& of(std::size_t model) const { return filters_[model]; }
  /// The model of the most evidence.
  [[nodiscard]] const MotionFilter& lead() const { return filters_[lead_]; }

 private:
  PerModel<MotionFilter> filters_;
  PerModel<double> evidence_{};
  std::size_t lead_ = 0;
};

}  // namespace tern
