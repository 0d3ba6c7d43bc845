// How well the vehicle follows its setpoints, for the log.
#pragma once

#include <optional>
#include <string>

#include "core/world/vehicle.h"
#include "mavlink/flight_identification.h"
#include "mavlink/tracking_lag.h"

namespace tern::mavlink {

/// Compares a flight's states with its commands, and measures drag and lag.
class TrackingReport {
 public:
  /// Takes a setpoint as it is sent, with all feed-forward.
  void sent(const MotionSample& setpoint) { identification_.sent(setpoint.p, setpoint.v, setpoint.a); }
  /// Takes a state and the command at its time. A state that is not newer than the last one is ignored.
  /// @param gains  nullopt: nothing can be measured
  void add(const UavState& state, const MotionSample& commanded, const std::optional<LoopGains>& gains);
  /// The vehicle does not follow for a while.
  void pause() { identification_.pause(); }

  /// Returns a line about a lag of more than 0.1 s, or "". @param drag_per_s  the setting that causes it, 1/s
  [[nodiscard]] std::string lag_line(double drag_per_s) const;
  /// Drag and lag as this flight shows them. nullopt: not a PX4, or not enough motion.
  [[nodiscard]] std::optional<FlightIdentification::Answer> measured() const { return identification_.answer(); }
  /// Returns them as a line with the settings for the next flight, or "".
  [[nodiscard]] std::string measured_line() const;

 private:
  TrackingLag lag_;
  FlightIdentification identification_;
  UTime at_;  ///< of the newest state
};

}  // namespace tern::mavlink
