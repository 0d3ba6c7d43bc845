// The age of the vehicle's state and status: on old ones nothing is requested or adopted.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/base/time.h"

namespace tern {

/// Remembers the newest UAV_STATE and VEHICLE_STATUS, by the time that each message states and by its receive time.
class VehicleInputs {
 public:
  /// A message is usable up to this age, by both times. VEHICLE_STATUS comes at 10 Hz: two in a row may be lost.
  static constexpr Duration kMaxAge{300'000};

  void add_state(UTime at, UTime received) { state_.add(at, received); }
  void add_status(UTime at, UTime received) { status_.add(at, received); }

  /// Whether both messages are usable.
  [[nodiscard]] bool usable(UTime now) const { return state_.usable(now) && status_.usable(now); }
  /// When usable() becomes false without further messages; it may be past.
  [[nodiscard]] UTime usable_until() const { return std::min(state_.usable_until(), status_.usable_until()); }
  /// The channel that is not usable, and why: {"UAV_STATE", "silent for 0.4 s"} or {"UAV_STATE", "2.0 s old"}. A
  /// channel without any message counts as silent. nullopt if both are usable.
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> trouble(UTime now) const;

 private:
  struct Input {
    std::optional<UTime> at, received;
    void add(UTime stated, UTime came);
    [[nodiscard]] UTime usable_until() const { return at ? std::min(*at, *received) + kMaxAge : UTime{0}; }
    [[nodiscard]] bool usable(UTime now) const { return at && now <= usable_until(); }
    [[nodiscard]] std::string trouble(UTime now) const;
  };
  Input state_, status_;
};

}  // namespace tern
