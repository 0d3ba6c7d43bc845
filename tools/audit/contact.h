// What had been predicted of the obstacle that a flight touched, before it did: was it seen, was it foretold, was it
// risked?
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "tools/audit/check.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// Promises are looked at that were made so long before the contact, s.
inline constexpr std::array kBeforeContact{0.25, 0.5, 1.0};

/// What one of them predicted of the time of the contact, on the axis on which it was worst.
struct PredictionAtContact {
  double needed_m = 0.0;  ///< α that would have held the true box; 0: it was inside without any
  double alpha_m = 0.0;   ///< what was promised
  bool covered = false;   ///< at all times up to the contact and on all axes
};

struct Contact {
  UTime at;  ///< vehicle's clock
  std::int64_t obstacle = kNoObstacle;
  double speed_mps = 0.0;                  ///< the vehicle's, by its last state until then
  std::optional<double> in_predictions_s;  ///< so long some track of it had been there; none: there was none
  std::array<std::optional<PredictionAtContact>, kBeforeContact.size()> predicted;  ///< none: it had no track then
  std::optional<double> confidence;   ///< of the last plan that claimed one, in (0, 1]
  std::optional<double> confident_s;  ///< how long before the contact that plan began, s, ≥ 0
};

/// @param at, obstacle  what was touched first, and when
Contact contact_at(const FlightRecord& record, UTime at, std::int64_t obstacle);

/// For people, a line for each thing that is known.
std::string to_text(const Contact& contact, const FlightRecord& record);
/// For programs: docs/after_the_flight.md lists the keys.
nlohmann::json to_json(const Contact& contact, const FlightRecord& record);

}  // namespace tern::audit
