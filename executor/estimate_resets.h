// By how much an estimator shifts the vehicle's position when it resets itself.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/time.h"
#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

/// VEHICLE_STATUS counts resets, UAV_STATE jumps: by what it is off where the state before led. Either may be heard
/// first. A jump of less than kMinJump is none, and one that no reset is told of within kMatchWindow is not the
/// estimator's.
class EstimateResets {
 public:
  static constexpr double kMinJump = 0.05;          ///< m; noise from state to state is less
  static constexpr Duration kMatchWindow{300'000};  ///< VEHICLE_STATUS comes at 10 Hz, UAV_STATE may come late
  static constexpr Duration kMaxStateGap{100'000};  ///< a state that comes later tells nothing of the one before

  /// @param at  the listener's time, not descending from call to call of either kind
  /// @return by how much the estimate was shifted (W, m), when that becomes known
  std::optional<Vec3> add(const UavState& state, UTime at);
  /// @param resets  VehicleStatus::resets
  std::optional<Vec3> add(std::int64_t resets, UTime at);

 private:
  struct Jump {
    UTime at;
    Vec3 by;
  };
  std::optional<Vec3> match();
  std::optional<UavState> before_;
  std::optional<std::int64_t> resets_;
  std::optional<Jump> unmatched_jump_;    ///< the newest that no reset was told of
  std::optional<UTime> unmatched_reset_;  ///< of a reset whose jump was not seen
};

}  // namespace tern
