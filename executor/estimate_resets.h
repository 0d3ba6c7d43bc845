// Detects resets of the vehicle's state estimator, and the shift of position that each one makes.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

/// Pairs the resets that VEHICLE_STATUS counts with the jumps of UAV_STATE.
///
/// A jump is the difference between a state's position and the previous state carried on by the mean of both
/// velocities. A reset and a jump belong together if they are received within kMatchWindow, in either order. Two cases
/// are ignored: a jump under kMinJump on every axis, and a jump without a reset. Nor does an outlier count. So the
/// state before a jump must agree with the one before it, and the state after it must not take it back.
class EstimateResets {
 public:
  static constexpr double kMinJump = 0.05;          ///< m; larger than the noise between two states
  static constexpr Duration kMatchWindow{300'000};  ///< VEHICLE_STATUS has 10 Hz, and UAV_STATE may be late
  static constexpr Duration kMaxStateGap{100'000};  ///< states farther apart are not compared

  /// Takes the next UAV_STATE.
  /// @param at  receive time; must not descend over the calls of both overloads
  /// @return the shift of the estimate (W, m), if this state completes a pair
  std::optional<Vec3> add(const UavState& state, UTime at);
  /// Takes the next VehicleStatus::resets. @return as above
  std::optional<Vec3> add(std::int64_t resets, UTime at);

 private:
  struct Jump {
    UTime at;
    Vec3 by;
    UavState from;  ///< the state before it
  };
  std::optional<Vec3> match();
  std::optional<UavState> before_;
  bool is_steady_ = false;  ///< before_ agrees with the state before it
  std::optional<std::int64_t> resets_;
  std::optional<Jump> newest_jump_;       ///< the jump to the newest state, which the next one may take back
  std::optional<Jump> unmatched_jump_;    ///< the newest jump without a reset
  std::optional<UTime> unmatched_reset_;  ///< receive time of the newest reset without a jump
};

}  // namespace tern
