// Autopilot parameters that decide what happens after a loss of messages and what can be flown, and the values that
// Tern requires.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "mavlink/autopilot.h"

namespace tern::mavlink {

struct RequiredParameter {
  const char* name;
  double low, high;    ///< allowed range, both included; high may be infinite
  double recommended;  ///< the value of docs/reference/autopilot.md
  bool integer;        ///< an integer in PX4, where it is sent bytewise in a float
  const char* why;     ///< reason, as in "the aircraft flies home at another height when setpoints cease"
  int bits = 0;        ///< bits of an integer that must be set
  int no_bits = 0;     ///< forbidden bits
  /// Not every firmware version has it under this name: its absence is no fault.
  bool may_be_absent = false;
  const char* also_called = nullptr;  ///< its name in other versions: one of the two is enough.
  /// Set for a bound of the vehicle: the scenario's value that must be within it.
  struct Bound {
    const char* key;       ///< "uav.dynamics.tilt_max"
    double planned;        ///< that value
    double scale = 1.0;    ///< its largest value is scale · parameter
    bool inverse = false;  ///< or scale / parameter
    bool root = false;     ///< or scale · √parameter
    bool writable = true;  ///< by raise_bounds; false: it is a property of the vehicle
    double advised = 0.8;  ///< share of the largest value that leaves a reserve for corrections
    [[nodiscard]] double largest(double value) const;
    /// The parameter's least value for `planned`, rounded up to an integer unless it is a share.
    [[nodiscard]] double least() const;
  };
  std::optional<Bound> bound = std::nullopt;

  [[nodiscard]] bool allows(double value) const;
  /// Whether set_parameters writes it.
  [[nodiscard]] bool may_be_written(bool raise_bounds) const { return !bound || (raise_bounds && bound->writable); }
};

/// Returns the table of docs/reference/autopilot.md: the behaviour after a loss, the vehicle's bounds that `uav` must
/// obey, and parameters that are only read. Empty for an unknown firmware.
///
/// Thrust: with the hover thrust h (share of the largest, MPC_THR_HOVER), the largest thrust per mass is about g/h.
/// @param system  the autopilot's system id, which the bridge uses as well
/// @param without_remote  there is neither a remote control nor a ground station
/// @param external_vision  the estimator uses the ODOMETRY that the bridge sends
/// @param values  the parameters that were read: what an ArduPilot must have depends on its other parameters
std::vector<RequiredParameter> required_parameters(Firmware firmware, const UavSpec& uav, std::uint8_t system,
                                                   bool without_remote, bool external_vision,
                                                   const std::map<std::string, double>& values = {});

/// Returns the faults with name, value, limit and reason: "COM_OBL_RC_ACT is 0, not within [4, 5]: …". For a bound that
/// is the key, and a value that fits: "uav.dynamics.tilt_max is 70, but MPC_TILTMAX_AIR is 45: 36 would fit".
/// Parameters that were not read are named. Empty: there is no fault.
/// @param all_asked  all were requested often enough that a missing one is absent
std::string parameter_faults(const std::vector<RequiredParameter>& required,
                             const std::map<std::string, double>& values, bool all_asked);

/// Returns what set_parameters would write: "would set COM_OBL_RC_ACT to 4 (it is 0)", and the remaining faults. All
/// parameters have been requested often enough that a missing one is absent.
std::string parameter_changes(const std::vector<RequiredParameter>& required,
                              const std::map<std::string, double>& values, bool raise_bounds);

}  // namespace tern::mavlink
