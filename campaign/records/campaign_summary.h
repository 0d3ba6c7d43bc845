// A campaign in numbers: what SUMMARY.json says, made from its flights alone.
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

/// Exposure to one region, over all flights that say it.
struct RegionExposure {
  Distribution seconds, metres, near_seconds, near_metres;
};

struct CampaignSummary {
  CampaignIdentity identity;
  std::int64_t flights = 0, reached = 0, collisions = 0, timeouts = 0, failed = 0;  ///< by outcome
  std::int64_t successes = 0;  ///< reached, within all limits, kept by the audit (is_success)
  std::int64_t different = 0;  ///< flights that differ from each other (different_flights)
  /// Wilson, of successes; nullopt where flights are equal: they say no more than one.
  std::optional<Interval> success_ci95;
  // Over the flights that reached the goal:
  Distribution flight_time_s, first_entry_s, path_length_m, mean_speed_mps, jerk_integral;
  // Over all flights:
  Distribution top_speed_mps, min_clearance_m, min_map_clearance_m;
  Distribution tracking_rmse_m, tracking_error_m, tube_m, tube_margin_m;  ///< of the audited ones
  std::int64_t stops = 0, flights_with_stops = 0, limit_violations = 0;
  std::int64_t contacts_moving = 0, contacts_at_rest = 0;
  std::optional<Interval> contact_moving_ci95;  ///< likewise, of flights with a contact while moving
  Distribution obstacles;                       ///< there at some time of a flight, by the referee
  std::int64_t obstacles_left_out = 0;
  std::int64_t requests = 0, deadlines_missed = 0, answers_refused = 0;
  std::map<std::string, std::int64_t> plans;              ///< answers by outcome
  std::array<Distribution, kMeasuredTimes.size()> times;  ///< over all answers of the timed flights
  std::int64_t timed_flights = 0;                         ///< of which the answers' times are known
  std::map<std::string, RegionExposure> exposure;         ///< by region, over all flights
  std::map<std::string, std::int64_t> audits;             ///< by verdict; empty: none was asked for
  std::vector<CoverageShare> coverage;                        ///< of predictions and of plans' claims; groups are flights
  std::vector<std::uint64_t> failed_seeds;                ///< of all that are no success
  std::vector<std::string> machines, compilers;           ///< on which and by which it was flown
};

/// @pre flights.records are of one identity
CampaignSummary summarize(const Flights& flights);

/// One JSON object; its keys are in campaign/README.md. What has no value is null. @param command  what was run
std::string to_json(const CampaignSummary& summary, const std::string& command);

/// The same for a person, some 15 lines.
std::string to_text(const CampaignSummary& summary);

}  // namespace tern
