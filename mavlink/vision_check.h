// Compares the external vision that an autopilot is sent with the estimate that it reports.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/world/vehicle.h"

namespace tern::mavlink {

/// An estimator that was without external vision for some 0.4 s may come back metres away from it. Then the vehicle's
/// position in the autopilot is wrong, and each setpoint leads away by the same distance.
///
/// | estimate minus vision, at the estimate's time                | fault()                                       |
/// |--------------------------------------------------------------|-----------------------------------------------|
/// | within the bound, horizontally and vertically                | none                                          |
/// | beyond it for kApartFor                                      | the distances, and for how long               |
/// | beyond it, and the estimator was reset since it was within   | the same, at once                             |
/// | no vision within kPairing of the estimate's time             | that of the newest comparison                 |
///
/// Positions are in the autopilot's local frame as ENU, m.
class VisionCheck {
 public:
  static constexpr Duration kApartFor{200'000};
  /// Vision is carried on by its velocity for at most this time.
  static constexpr Duration kPairing{100'000};

  /// @param bound_m  largest difference, horizontally and vertically, m
  explicit VisionCheck(double bound_m) : bound_m_(bound_m) {}

  /// Takes a state that was sent as external vision.
  void sent(const UavState& vision);
  /// Takes an estimate. @param resets  the estimator's resets so far
  void estimated(const UavState& estimate, int resets);

  /// Why the estimate cannot be flown by, or "".
  [[nodiscard]] std::string fault() const;
  /// How long the difference has been beyond the bound without a break; zero if it is within.
  [[nodiscard]] Duration apart_for() const { return since_ ? newest_ - *since_ : Duration{}; }
  /// Time of the newest vision.
  [[nodiscard]] std::optional<UTime> newest_vision() const;

 private:
  double bound_m_;
  std::deque<UavState> vision_;  ///< by time
  UTime newest_;                 ///< time of the newest comparison
  std::optional<UTime> since_;   ///< the difference is beyond the bound
  int resets_within_ = 0;        ///< the estimator's resets when the difference was last within
  bool was_reset_ = false;
  double level_m_ = 0.0, up_m_ = 0.0;
};

}  // namespace tern::mavlink
