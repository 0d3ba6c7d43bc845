#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/world/names.h"
#include "monitor/flight_summary.h"

namespace tern {
namespace {

// Keeps the order of insertion; NaN and infinity become null when it is written.
using Json = nlohmann::ordered_json;

Json to_json(const Percentiles& p) { return {{"p50", p.p50}, {"p95", p.p95}, {"p99", p.p99}, {"max", p.max}}; }

Json to_json(const ReplanTimes& times) {
  return {{"total", to_json(times.total)},
          {"first_answer", to_json(times.first_answer)},
          {"hulls", to_json(times.hulls)},
          {"search", to_json(times.search)},
          {"optimization", to_json(times.optimization)},
          {"check", to_json(times.check)}};
}

/// The referee's measure, or null.
template <class T>
Json measure(const std::optional<FlightResult>& result, T FlightResult::*field) {
  return result ? Json((*result).*field) : Json(nullptr);
}

template <class T>
Json known(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json to_json(const std::optional<FlownSettings>& settings) {
  if (!settings) return nullptr;
  return {{"lambda_attractive", settings->lambda_attractive},
          {"lambda_repulsive", settings->lambda_repulsive},
          {"v_max", to_json(settings->limits.v_max)},
          {"a_max", to_json(settings->limits.a_max)},
          {"j_max", to_json(settings->limits.j_max)}};
}

Json plans_by_outcome(const FlightSummary& summary) {
  Json plans = Json::object();
  for (int k = 0; k < kPlanOutcomes; ++k) {
    plans[key(static_cast<PlanOutcome>(k))] = summary.plans[idx(k)];
  }
  return plans;
}

Json plans_by_confidence(const FlightSummary& summary) {
  Json plans = {
      {"promised", summary.by_level.front()}, {"for_a_time", summary.for_a_time}, {"below", summary.by_level.back()}};
  for (std::size_t k = 1; k < kConfidenceLevels.size(); ++k) {
    plans[fmt::format("{}", kConfidenceLevels[k])] = summary.by_level[k];
  }
  return plans;
}

Json recording(const FlightSummary& summary) {
  if (!summary.recording) return nullptr;
  return summary.recording->empty() ? "complete" : "incomplete: " + *summary.recording;
}

Json exposure_by_region(const std::optional<FlightResult>& result) {
  Json regions = Json::object();
  if (!result) return regions;
  for (const Exposure& e : result->exposure) regions[e.region] = {{"seconds", e.seconds}, {"metres", e.metres}};
  return regions;
}

Json messages_by_channel(const FlightSummary& summary) {
  Json messages = Json::object();
  for (const auto& [channel, count] : summary.messages) {
    messages[channel] = {{"received", count.received}, {"rejected", count.rejected}, {"lost", count.lost}};
  }
  return messages;
}

}  // namespace

std::string to_json(const FlightSummary& summary) {
  const auto& result = summary.result;
  const Json json = {
      {"outcome", to_string(summary.outcome)},
      {"detail", summary.detail},
      {"cause", to_string(summary.explanation.cause)},
      {"why", summary.explanation.sentence},
      {"recording", recording(summary)},
      {"scenario", summary.scenario},
      {"seed", known(summary.seed)},
      {"count", known(summary.count)},
      {"settings", to_json(summary.settings)},
      {"flight_time_s", measure(result, &FlightResult::flight_time_s)},
      {"first_entry_s", measure(result, &FlightResult::first_entry_s)},
      {"path_length_m", measure(result, &FlightResult::path_length_m)},
      {"mean_speed_mps", measure(result, &FlightResult::mean_speed_mps)},
      {"top_speed_mps", measure(result, &FlightResult::top_speed_mps)},
      {"stops", measure(result, &FlightResult::stops)},
      {"min_clearance_m", measure(result, &FlightResult::min_clearance_m)},
      {"min_map_clearance_m", measure(result, &FlightResult::min_map_clearance_m)},
      {"limit_violations", measure(result, &FlightResult::limit_violations)},
      {"contacts_moving", measure(result, &FlightResult::contacts_moving)},
      {"contacts_at_rest", measure(result, &FlightResult::contacts_at_rest)},
      {"obstacles", measure(result, &FlightResult::obstacles)},
      {"obstacles_left_out", measure(result, &FlightResult::obstacles_left_out)},
      {"requests", summary.requests},
      {"answered_in_time", summary.answered_in_time},
      {"second_answers", summary.second_answers},
      {"plans", plans_by_outcome(summary)},
      {"confidence", plans_by_confidence(summary)},
      {"left_out", {{"plans", summary.left_out.plans}, {"most_tracks", summary.left_out.max_tracks}}},
      {"passively_safe_share", known(summary.passively_safe_share)},
      {"replan_ms", to_json(summary.replan_ms)},
      {"exposure", exposure_by_region(result)},
      {"messages", messages_by_channel(summary)},
      {"restarts", summary.restarts},
      {"said", Json(summary.said)},
      {"beside", Json(summary.concurrent)},
      {"log", summary.log.empty() ? Json(nullptr) : Json(summary.log)},
      {"command", summary.command.empty() ? Json(nullptr) : Json(summary.command)},
      {"pace", summary.pace},
      {"version", summary.version},
  };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tern
