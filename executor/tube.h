// The tube: how far the vehicle may be from its setpoints, per axis, measured in flight.
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

/// Largest tube, m per axis. A vehicle that is farther from its setpoints does not follow them.
inline constexpr double kMaxTube = 2.0;

/// Smaller errors count as 0, m: they are rounding, or due to a trajectory that the vehicle has not received yet.
inline constexpr double kMinError = 1e-3;

/// The error that all newest states have in common. Per axis it is the least error of the states of the last kWindow,
/// or of the last kMinStates states if those are more. A single state that disagrees with its neighbours, by noise or
/// because it is forged, does not raise it.
class PersistentError {
 public:
  static constexpr Duration kWindow{20'000};
  static constexpr std::size_t kMinStates = 3;
  /// @param error  per axis, m
  /// @param received  receive time, ascending; the state's own time may be wrong
  /// @return the persistent error per axis, m; zero before kMinStates states
  Vec3 add(const Vec3& error, UTime received);

 private:
  struct Seen {
    UTime received;
    Vec3 error;
  };
  std::deque<Seen> newest_;
};

/// Measures the tube that requests contain.
///
/// The width per axis is the largest of the floor, the width at rest and the width in motion, at most kMaxTube. Both
/// widths are kMargin times a split-conformal quantile, plus three standard deviations of the estimate. They are
/// rounded up to kTubeStep, so that they change seldom.
///
/// The quantile has the level 1 − kMissedShare. Its samples are the largest errors of the last kMaxSeconds seconds, one
/// per second. (Errors of neighbouring instants are dependent, those of whole seconds are nearly exchangeable.) While
/// fewer than kPriorSeconds are known, the missing ones count as error 0. In motion at share() 1 they count as
/// kPriorError once an error has reached kMinError.
///
/// | event                               | effect                                                                  |
/// |-------------------------------------|-------------------------------------------------------------------------|
/// | the vehicle leaves the tube         | for kWidenedFor the width is 1.5 times as large                         |
/// | the vehicle follows again           | forgets errors and exits since a second before it ceased to follow:     |
/// |                                     | their cause was reported, and is over                                   |
/// | the estimator is reset              | the width grows by the shift: either position may be the true one       |
/// | at rest, the planner finds no way   | share() is halved, once in kStepPeriod, at most kMaxHalvings times      |
/// | a new plan arrives                  | share() is doubled, if it has not changed during the patience           |
///
/// share() is the part of the vehicle's limits that requests contain. Tracking errors grow with speed and acceleration,
/// so a slower vehicle fits through a smaller opening. Each halving also halves the width in motion, but not below the
/// one measured at that share. After a start in collision it halves the floor as well, until share() rises. So a
/// vehicle gets away from a surface that was seen late. A goal or a way that the floor blocks stays blocked.
///
/// The patience is kPatience/share(), at most kMaxPatience. It is doubled if share() falls again within the patience
/// after it has risen, and is otherwise reset.
class Tube {
 public:
  static constexpr double kTubeStep = 0.05;         ///< m
  static constexpr double kMissedShare = 0.02;      ///< share of seconds beyond the quantile
  static constexpr double kMargin = 1.5;            ///< on the quantile: a flight should not leave the tube even once
  static constexpr double kPriorError = 0.2;        ///< m; with kMargin the tube begins with 0.3 m
  static constexpr std::size_t kPriorSeconds = 50;  ///< the fewest seconds of which 2 % can be missed
  static constexpr Duration kSecond{1'000'000};     ///< span over which the largest error is taken
  static constexpr std::size_t kMaxSeconds = 120;
  static constexpr Duration kWidenedFor{5'000'000};
  static constexpr Duration kComesBack{60'000'000};
  static constexpr Duration kStepPeriod{250'000};
  static constexpr int kMaxHalvings = 5;
  static constexpr Duration kPatience{2'000'000}, kMaxPatience{60'000'000};

  /// @param floor_m  smallest width at share() 1, [0, kMaxTube]
  explicit Tube(double floor_m) : floor_m_(floor_m) {}

  /// Adds a tracking error. @param error  |measured − commanded| per axis, m
  /// @param rests  the committed trajectory has been at rest for a while @param at  ascending
  void add(const Vec3& error, bool rests, UTime at);
  /// Notes an error that is not used for the quantile. With one of kMinError or more the vehicle counts as imperfect.
  void note_error(const Vec3& error) { has_error_ = has_error_ || (error.array() >= kMinError).any(); }
  /// The vehicle counts as imperfect, even if no error was seen.
  void assume_errors() { has_error_ = true; }
  /// Forgets errors and exits since then: the vehicle has reported their cause and its end. If it was called within
  /// the last kComesBack, it has no effect: a cause that comes back is not over.
  void forget_since(UTime since);
  /// The vehicle has left its tube.
  void add_exit(UTime at) { exited_ = at; }
  /// The estimator has reset itself. @param by  shift of the position, m, W
  void add_shift(const Vec3& by);
  /// Takes the planner's answer to a request. @param rests  the committed trajectory is at rest
  void on_answer(const Plan& plan, bool rests, UTime at);
  /// The width per axis, m. @param sigma  standard deviation of the estimate per axis, m, ≥ 0
  [[nodiscard]] Vec3 width(const Vec3& sigma, UTime now) const;
  /// The share of the vehicle's limits that requests contain, (0, 1].
  [[nodiscard]] double share() const;
  /// The smallest width now, m.
  [[nodiscard]] double floor_m() const;

 private:
  void slow_down(bool lies_in_floor, UTime at);
  void speed_up(UTime at);
  struct Second {
    UTime start;
    Vec3 largest = Vec3::Zero();
  };
  using Seconds = std::deque<Second>;
  /// Width from the errors in motion, m. @param unsure  the estimate's part of it, m
  [[nodiscard]] double moving_width(int axis, double unsure) const;
  [[nodiscard]] static double quantile(const Seconds& seconds, double prior, int axis);
  /// Whether the share has not changed for `span`.
  [[nodiscard]] bool unchanged_for(Duration span, UTime at) const { return !stepped_ || at - *stepped_ >= span; }
  /// How long the share stays as it is before a step up.
  [[nodiscard]] Duration patience() const { return std::min(patience_ * (1 << halvings_), kMaxPatience); }

  double floor_m_;
  /// Sum of all shifts, and its least and largest value per axis so far.
  Vec3 shift_ = Vec3::Zero(), min_shift_ = Vec3::Zero(), max_shift_ = Vec3::Zero();
  std::optional<UTime> exited_, stepped_, forgot_;
  int halvings_ = 0, floor_halvings_ = 0;  ///< floor_halvings_ ≤ halvings_
  bool stepped_up_ = false;                ///< the newest step was one up
  Duration patience_ = kPatience;
  bool has_error_ = false;
  std::array<Seconds, kMaxHalvings + 1> moving_;  ///< by halvings
  Seconds resting_;
};

}  // namespace tern
