// The summary of a campaign (SUMMARY.json), computed from its flights alone.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaign/records/flight_table.h"
#include "campaign/statistics/distribution.h"
#include "campaign/statistics/wilson.h"

namespace tern {

/// Time (s) and path (m) inside one region, over all flights that report it; near_: inside or within 1 m of it.
struct RegionExposure {
  Distribution seconds, metres, near_seconds, near_metres;
};

/// Counts and distributions over the flights of a campaign.
struct CampaignSummary {
  CampaignIdentity identity;
  std::int64_t flights = 0, reached = 0, collisions = 0, timeouts = 0, failed = 0;  ///< by outcome
  std::int64_t successes = 0;  ///< reached, within all limits, not broken by the audit (is_success)
  std::int64_t different = 0;  ///< distinct flights; equal flights count once (different_flights)
  /// Wilson interval of successes; nullopt if some flights are equal, since equal flights add no information.
  std::optional<Interval> success_ci95;
  // Over the flights that reached the goal:
  Distribution flight_time_s, first_entry_s, path_length_m, mean_speed_mps, jerk_integral;
  // Over all flights:
  Distribution top_speed_mps, min_clearance_m, min_map_clearance_m;
  Distribution tracking_rmse_m, tracking_error_m, tube_m, tube_margin_m;  ///< of the audited flights
  Distribution passively_safe_share;  ///< of the flights with `planner.unseen: passive`
  std::int64_t stops = 0, flights_with_stops = 0, limit_violations = 0;
  std::int64_t contacts_moving = 0, contacts_at_rest = 0;
  std::optional<Interval> contact_moving_ci95;  ///< Wilson interval of flights with a contact while moving
  Distribution obstacles;                       ///< how many exist at some time of a flight
  std::int64_t obstacles_left_out = 0;
  std::int64_t requests = 0, deadlines_missed = 0, answers_refused = 0;
  std::map<std::string, std::int64_t> plans;              ///< answers by outcome
  std::array<Distribution, kMeasuredTimes.size()> times;  ///< over all answers of the timed flights
  std::int64_t timed_flights = 0;                         ///< flights with known answer times
  std::map<std::string, RegionExposure> exposure;         ///< by region, over all flights
  std::map<std::string, std::int64_t> audits;             ///< by verdict; empty: no audit
  std::vector<CoverageShare> coverage;           ///< of predictions and of plans' claims; each flight is a group
  std::vector<std::uint64_t> failed_seeds;       ///< of all flights without success
  std::vector<std::string> machines, compilers;  ///< that flew the campaign
};

/// @pre flights.records have the same identity
CampaignSummary summarize(const Flights& flights);

/// Returns one JSON object; docs/reference/campaign.md lists its keys. Unknown values are null.
/// @param command  the command line to record
std::string to_json(const CampaignSummary& summary, const std::string& command);

/// Returns the summary as text for people, in about 15 lines.
std::string to_text(const CampaignSummary& summary);

}  // namespace tern
