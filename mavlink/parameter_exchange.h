// Reads an autopilot's parameters, writes the required ones, and sets them back.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mavlink/autopilot.h"
#include "mavlink/outbox.h"
#include "mavlink/required_parameters.h"

namespace tern::mavlink {

/// The parameters of a flight: those of the table are read and, where that is allowed, written. After the flight the
/// written ones are restored.
class ParameterExchange {
 public:
  /// After this many requests, a parameter without an answer counts as absent. If 20 % of the packets are lost in one
  /// direction, all six are lost with probability 0.2⁶ = 6·10⁻⁵.
  static constexpr int kMaxRounds = 6;

  /// Permission to write with a request.
  struct Writes {
    bool allowed = false;       ///< write recommended values
    bool raise_bounds = false;  ///< also those of the vehicle's bounds
  };

  explicit ParameterExchange(UTime now) : next_(now) {}

  /// Requests every parameter of the table, except those with an allowed value. Once per period.
  void request(const std::vector<RequiredParameter>& required, const Autopilot& autopilot, const Writes& writes,
               UTime now, Outbox& out);
  /// Sets back what was written, until the autopilot has confirmed it. The vehicle must be disarmed.
  ///
  /// The autopilot answers each PARAM_SET with the new value. An original value that is known from before may be stale:
  /// the answer to the write was lost, or is on its way.
  void set_back(const Autopilot& autopilot, UTime now, Outbox& out);

  /// Whether all were requested often enough that a missing one is absent.
  [[nodiscard]] bool all_asked() const { return rounds_ >= kMaxRounds; }
  /// Whether the autopilot still has parameters that were written.
  [[nodiscard]] bool has_written() const { return !originals_.empty(); }

 private:
  struct Original {
    double value = 0.0;
    bool integer = false;
    bool asked_back = false;  ///< it was sent back: from then on the autopilot's answer counts
  };
  std::map<std::string, Original> originals_;  ///< of the parameters that were written
  int rounds_ = 0;                             ///< of requests
  Timer next_;
};

}  // namespace tern::mavlink
