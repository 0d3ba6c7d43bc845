// How far the vehicle is off its setpoints: the bound that a request promises, measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// No tube is wider, m: a vehicle that is farther off does not follow.
inline constexpr double kWidestTube = 2.0;

/// An error of less is none, m: rounding, and a trajectory that the vehicle has not heard of yet.
inline constexpr double kNothing = 1e-3;

/// The tube from what was measured, per axis: the split-conformal quantile of the largest errors of the last two
/// minutes' seconds (errors of neighbouring instants are alike, those of whole seconds nearly exchangeable), plus three
/// standard deviations of the estimate that the errors were measured by. Rounded up to kTubeStep, so that it changes
/// seldom; 0 while no error reached kNothing. Never under the floor, never over kWidestTube.
///
/// A vehicle that was pushed out and got a new trajectory (left) tells of an event, not of its tracking: such errors
/// are not for add(); for kWidened the tube is half as wide again. Where the planner finds the start in collision with
/// the tube about it (blocked), the next request promises half of it, down to the floor, until plans are flown again:
/// who stays between obstacles because of what he might do is no safer.
class Tube {
 public:
  static constexpr double kTubeStep = 0.05;        ///< m
  static constexpr double kMissed = 0.02;          ///< share of seconds that may leave it
  static constexpr Duration kSecond{1'000'000};    ///< over which the largest error counts
  static constexpr std::size_t kRemembered = 120;  ///< seconds
  static constexpr Duration kWidened{5'000'000};
  static constexpr int kMostHalvings = 5;

  /// @param floor_m  promised at least, [0, kWidestTube]
  explicit Tube(double floor_m) : floor_m_(floor_m) {}

  /// @param error  |measured − commanded| per axis, m. Times ascend
  void add(const Vec3& error, UTime at);
  void left(UTime at) { left_ = at; }
  void blocked() { halvings_ = std::min(halvings_ + 1, kMostHalvings); }
  void flown() { halvings_ = std::max(halvings_ - 1, 0); }
  /// @param sigma  of the estimate per axis, m, ≥ 0
  [[nodiscard]] Vec3 width(const Vec3& sigma, UTime now) const;

 private:
  struct Second {
    UTime start;
    Vec3 largest = Vec3::Zero();
  };
  [[nodiscard]] double quantile(int axis) const;

  double floor_m_;
  std::optional<UTime> left_;
  int halvings_ = 0;
  std::deque<Second> seconds_;
};

}  // namespace tern
