// Bounds how far and how often the committed trajectory may be moved to where the vehicle is measured.
#pragma once

#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/base/types.h"

namespace tern {

/// A rejoin moves the commanded position to the measured one. The estimate may be in another frame than the autopilot:
/// after a loop closure, in NED, in millimetres. Then the vehicle moves along, and the next measurement is equally far
/// off. The guard ends this positive feedback.
///
/// | the measured position                                            | answer                                      |
/// |------------------------------------------------------------------|---------------------------------------------|
/// | outside the flight box by more than kStartOutside, at a start    | refused                                     |
/// | farther than the start reach from uav.start, at a start          | refused                                     |
/// | outside the bound below, when the vehicle follows again          | refused                                     |
/// | outside the flight box by up to kMaxExcursion, the first time    | allowed; the excursion is the new bound     |
/// | outside that bound                                               | refused                                     |
/// | off the trajectory, sum of shifts up to kMaxShift                | allowed; the sum decays by kForgiven        |
/// | off the trajectory, sum above kMaxShift                          | refused                                     |
///
/// A reset that the estimator announces counts in the same sum. The tube grows by the reset, so it needs no rejoin, but
/// the vehicle is led away all the same. A rejoin within kSameShift of a reset is taken for the same shift.
///
/// After a refusal of check_rejoin() or check_reset() the vehicle must not be commanded any further.
class RejoinGuard {
 public:
  static constexpr double kStartOutside = 0.5;    ///< m beyond the flight box, per axis: a vehicle that climbs there
  static constexpr double kMaxExcursion = 2.0;    ///< m beyond the flight box, per axis
  static constexpr double kExcursionStep = 0.25;  ///< m: later excursions may exceed the first one by this
  static constexpr double kMinExcursion = 0.5;    ///< m: a first excursion counts as at least this large on each side
  static constexpr double kMaxShift = 3.0;        ///< m: sum of the rejoins' distances
  static constexpr double kForgiven = 0.05;       ///< m/s: the sum decays at this rate

  /// A jump of UAV_STATE and VEHICLE_STATUS, which announces it at 10 Hz, may be this far apart.
  static constexpr Duration kSameShift{500'000};

  /// @param allowed  where the vehicle's centre may be so that its body is inside the flight box, W
  /// @param start_reach_m  farthest start from uav.start, m
  explicit RejoinGuard(const Box& allowed, double start_reach_m = 5.0)
      : allowed_(allowed), start_reach_m_(start_reach_m) {}

  /// @param start  uav.start @param has_flown  whether the vehicle was commanded before
  /// @return why the vehicle at p must not be commanded, as text; nullopt if it may
  [[nodiscard]] std::optional<std::string> check_start(const Vec3& p, const Vec3& start, bool has_flown) const;
  /// Checks a rejoin and adds it to the sum if it is allowed.
  /// @param commanded  position of the committed trajectory; measured: of the vehicle, both at the same time
  /// @param counts  false if the shift is not the estimate's: the vehicle was not following, or the executor was silent
  /// @return why the vehicle must not be commanded any further, as text; nullopt if it may rejoin
  [[nodiscard]] std::optional<std::string> check_rejoin(const Vec3& commanded, const Vec3& measured, bool counts,
                                                        UTime at);
  /// Adds an announced reset of the estimator. @param by  its shift, m, W  @return as check_rejoin
  [[nodiscard]] std::optional<std::string> check_reset(const Vec3& by, UTime at);
  /// Takes the trajectory that a rejoin has committed to. If it leaves the flight box, its bounds are the first
  /// excursion. @param flown  bounds of the positions
  void add_excursion(const Box& flown);
  /// Whether a setpoint at p may be published.
  [[nodiscard]] bool may_command(const Vec3& p) const;

 private:
  /// Where the vehicle may be commanded: the flight box and the first excursion, or kMaxExcursion before there is one.
  [[nodiscard]] Box bound() const;
  struct Shift {
    bool is_reset = false;
    double by = 0.0;  ///< m
    UTime at;
  };
  /// The sum of shifts with this one. The caller keeps it if the sum is allowed.
  [[nodiscard]] double sum_with(const Shift& next) const;
  void keep(const Shift& next, double sum);

  Box allowed_;
  double start_reach_m_;
  std::optional<Box> excursion_;
  double shift_ = 0.0;  ///< m, at last_
  Shift last_;
};

}  // namespace tern
