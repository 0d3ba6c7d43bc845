// What was known of the obstacle that a flight touched: was it tracked, did predictions cover it, was the risk
// accepted?
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "tools/audit/check.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// How long before the contact predictions are examined, s.
inline constexpr std::array kBeforeContact{0.25, 0.5, 1.0};

/// One earlier prediction for the time of contact, on the axis with the smallest margin.
struct PredictionAtContact {
  double needed_m = 0.0;  ///< the error bound α that would have covered the true box; 0: covered without any
  double alpha_m = 0.0;   ///< the α that was predicted
  bool covered = false;   ///< on every axis, at all times up to the contact
};

/// A contact, and the predictions and plans before it.
struct Contact {
  UTime at;  ///< vehicle's clock
  std::int64_t obstacle = kNoObstacle;
  double speed_mps = 0.0;                  ///< of the vehicle, from its last state before the contact
  std::optional<double> in_predictions_s;  ///< age of the obstacle's track; none: it had no track
  std::array<std::optional<PredictionAtContact>, kBeforeContact.size()> predicted;  ///< none: it had no track then
  std::optional<double> confidence;   ///< of the last plan with a confidence, in (0, 1]
  std::optional<double> confident_s;  ///< start of that plan, s before the contact, ≥ 0
};

/// @param at, obstacle  time of the first contact, and the obstacle that was touched
Contact contact_at(const FlightRecord& record, UTime at, std::int64_t obstacle);

/// Text for people: a line per known fact.
std::string to_text(const Contact& contact, const FlightRecord& record);
/// JSON for programs; docs/reference/audit.md lists the keys.
nlohmann::json to_json(const Contact& contact, const FlightRecord& record);

}  // namespace tern::audit
