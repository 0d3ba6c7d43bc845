// How far the vehicle is off its setpoints: the bound that a request promises, measured.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/horizon.h"

namespace tern {

/// No tube is wider, m: a vehicle that is farther off does not follow.
inline constexpr double kMaxTube = 2.0;

/// An error of less is none, m: rounding, and a trajectory that the vehicle has not heard of yet.
inline constexpr double kMinError = 1e-3;

/// What all of the newest states show of an error, per axis: those of the last kWindow, kMinStates at least. A state
/// that tells another tale than those beside it, be it noise or a lie in the vehicle's name, shows nothing.
class PersistentError {
 public:
  static constexpr Duration kWindow{20'000};
  static constexpr std::size_t kMinStates = 3;
  /// @param error  per axis, m
  /// @param received  by the listener's clock: what the state says of its time may be wrong as well. Ascending
  /// @return zero before kMinStates states have come
  Vec3 add(const Vec3& error, UTime received);

 private:
  struct Seen {
    UTime received;
    Vec3 error;
  };
  std::deque<Seen> newest_;
};

/// The tube from what was measured, per axis: kMargin times a split-conformal quantile, plus three standard deviations
/// of the estimate that the errors were measured by. The quantile is of the largest errors of the last two minutes'
/// seconds: errors of neighbouring instants are alike, those of whole seconds nearly exchangeable. Until there are
/// kPriorSeconds seconds the rest count with kPriorError: a vehicle that shows any error tracks no better than a
/// well-tuned autopilot. Rounded up to kTubeStep, so that it changes seldom; 0 while no error reached kMinError. Never
/// under the floor, never over kMaxTube.
///
/// A vehicle that was pushed out and got a new trajectory (left) tells of an event, not of its tracking: such errors
/// are not for add(); for kWidenedFor the tube is half as wide again.
///
/// Where the estimator shifts the vehicle's position (shifted), either the place before is right or the one after, and
/// nobody says which. From then on the tube is wider by the shift: the true place stays within it, whichever it is.
///
/// Where the vehicle rests and the tube leaves no way (blocked), it is asked to fly slower: errors of tracking grow
/// with speed and acceleration. The next request has limits of half the size (share) and promises half the tube, but no
/// less than was measured at rest, or so slowly. It is halved again until plans are flown, one step in kStepPeriod at
/// most. So it goes on for kPatience/share, as long as an opening may be ahead; then a step up is tried. One that ends
/// blocked doubles the patience, one that lasts ends that.
class Tube {
 public:
  static constexpr double kTubeStep = 0.05;         ///< m
  static constexpr double kMissedShare = 0.02;      ///< share of seconds that may leave the quantile
  static constexpr double kMargin = 1.5;            ///< over it: a flight shall not leave the tube even once
  static constexpr double kPriorError = 0.2;        ///< m: the tube begins with 0.3 m
  static constexpr std::size_t kPriorSeconds = 50;  ///< seconds: the fewest of which 2 % may be missed
  static constexpr Duration kSecond{1'000'000};     ///< over which the largest error counts
  static constexpr std::size_t kMaxSeconds = 120;   ///< seconds
  static constexpr Duration kWidenedFor{5'000'000};
  static constexpr Duration kStepPeriod{250'000};
  static constexpr int kMaxHalvings = 5;
  static constexpr Duration kPatience{2'000'000}, kMaxPatience{60'000'000};

  /// @param floor_m  promised at least, [0, kMaxTube]
  explicit Tube(double floor_m) : floor_m_(floor_m) {}

  /// @param error  |measured − commanded| per axis, m. Times ascend
  /// @param rests  it is commanded to rest, and has been for a while
  void add(const Vec3& error, bool rests, UTime at);
  /// An error that tells only that the vehicle is not perfect.
  void note_error(const Vec3& error) { has_error_ = has_error_ || (error.array() >= kMinError).any(); }
  /// It is not perfect, though at rest it shows no error.
  void assume_errors() { has_error_ = true; }
  void add_exit(UTime at) { exited_ = at; }
  /// The estimator has reset itself. @param by  m, W
  void add_shift(const Vec3& by);
  /// What came of a request. @param rests  the vehicle is commanded to rest
  void on_answer(const Plan& plan, bool rests, UTime at);
  /// @param sigma  of the estimate per axis, m, ≥ 0
  [[nodiscard]] Vec3 width(const Vec3& sigma, UTime now) const;
  /// Of the vehicle's limits that requests ask for, (0, 1].
  [[nodiscard]] double share() const;

 private:
  void slow_down(UTime at);
  void speed_up(UTime at);
  struct Second {
    UTime start;
    Vec3 largest = Vec3::Zero();
  };
  using Seconds = std::deque<Second>;
  /// Of a vehicle that moves, m.
  [[nodiscard]] double moving_width(int axis, double unsure) const;
  [[nodiscard]] static double quantile(const Seconds& seconds, double prior, int axis);
  /// The newest step is this long ago, or there was none.
  [[nodiscard]] bool unchanged_for(Duration span, UTime at) const { return !stepped_ || at - *stepped_ >= span; }
  /// For how long it flies so slowly.
  [[nodiscard]] Duration patience() const { return std::min(patience_ * (1 << halvings_), kMaxPatience); }

  double floor_m_;
  /// The sum of all shifts, and the least and largest that it was.
  Vec3 shift_ = Vec3::Zero(), min_shift_ = Vec3::Zero(), max_shift_ = Vec3::Zero();
  std::optional<UTime> exited_, stepped_;
  int halvings_ = 0;
  bool stepped_up_ = false;  ///< the newest step was one up
  Duration patience_ = kPatience;
  bool has_error_ = false;
  std::array<Seconds, kMaxHalvings + 1> moving_;  ///< by halvings
  Seconds resting_;
};

}  // namespace tern
