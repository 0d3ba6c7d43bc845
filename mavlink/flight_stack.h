// The behaviour of autopilot firmwares: modes, take-off, setpoints, gains.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/base/types.h"
#include "mavlink/fed_offset.h"
#include "mavlink/flight_identification.h"
#include "mavlink/messages.h"
#include "mavlink/tilt_ramp.h"

namespace tern::mavlink {

enum class Firmware : std::uint8_t { Px4, ArduPilot, Other };

/// Parameters of an autopilot that were read, by name.
using ParameterValues = std::map<std::string, double>;
/// Returns the value of a parameter, or `otherwise` if it was not read.
double value_or(const ParameterValues& parameters, const std::string& name, double otherwise);

/// Parameters 1 to 7 of a COMMAND_LONG.
using CommandParams = std::array<float, 7>;

/// A stream that an autopilot sends only, or often enough, on request.
struct StreamRequest {
  std::uint32_t message = 0;
  float interval_us = 0.0F;
};

/// The behaviour of a firmware. Stateless: all values that a vehicle has of its own are arguments.
class FlightStack {
 public:
  virtual ~FlightStack() = default;

  /// The name of a mode: "OFFBOARD", "GUIDED", "AUTO.LAND". @param custom  HEARTBEAT.custom_mode
  [[nodiscard]] virtual std::string mode(std::uint32_t custom) const = 0;
  /// The parameters of DO_SET_MODE for a mode.
  [[nodiscard]] virtual CommandParams mode_command(std::uint32_t custom) const = 0;
  /// The mode that follows setpoints, and the parameters of DO_SET_MODE for it.
  [[nodiscard]] virtual const char* following_mode() const = 0;
  [[nodiscard]] virtual CommandParams following_command() const = 0;
  /// The mode that lands, and the parameters of NAV_LAND for a landing at the present place.
  [[nodiscard]] virtual const char* landing_mode() const = 0;
  [[nodiscard]] virtual CommandParams landing_command() const = 0;

  /// Whether it takes off by NAV_TAKEOFF. Setpoints do not lift it off the ground, and end such a take-off.
  [[nodiscard]] virtual bool takes_off_by_command() const = 0;
  /// Whether it holds a setpoint until the next one. Otherwise it extrapolates.
  [[nodiscard]] virtual bool holds_setpoints() const = 0;
  /// Whether setpoints return it to the following mode, in any failsafe.
  [[nodiscard]] virtual bool setpoints_end_failsafe() const = 0;
  /// Whether PARAM_VALUE contains the four bytes of an integer, and not its value as a float.
  [[nodiscard]] virtual bool sends_integers_bytewise() const = 0;

  // The following are, unless overridden, those of a firmware whose loops are unknown.

  /// The same for PARAM_SET.
  [[nodiscard]] virtual bool takes_integers_bytewise() const { return false; }
  /// Whether it sends STATUSTEXT only to a link with a ground station.
  [[nodiscard]] virtual bool tells_ground_stations_only() const { return false; }
  /// Streams beyond those that are requested of every firmware.
  [[nodiscard]] virtual std::vector<StreamRequest> streams() const { return {}; }
  /// The share of the present acceleration that its velocity loop opposes, per axis.
  [[nodiscard]] virtual Vec3 derivative_gain(const ParameterValues& parameters) const;
  /// Gains of its level loops as read, or nullopt: not read, or of another form.
  [[nodiscard]] virtual std::optional<LoopGains> level_gains(const ParameterValues& parameters) const;
  /// The level loops of a firmware that integrates the acceleration of its setpoints (FedOffset). nullopt: it adds that
  /// acceleration to the one of its loops.
  [[nodiscard]] virtual std::optional<CopterLoops> integrating_loops(const ParameterValues& parameters) const;
  /// Time by which the acceleration is behind its command.
  [[nodiscard]] virtual Duration tilt_lag(const ParameterValues& parameters) const;
  /// How long the tilt stays limited after a take-off.
  [[nodiscard]] virtual Duration tilt_limited(const ParameterValues& parameters, const TiltRamp& ramp, UTime now) const;
};

/// Returns the behaviour of a firmware. An unknown firmware has the modes of a PX4, and none of its gains and limits.
const FlightStack& flight_stack(Firmware firmware);

}  // namespace tern::mavlink
