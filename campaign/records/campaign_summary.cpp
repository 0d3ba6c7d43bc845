#include "campaign/records/campaign_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "campaign/records/campaign_comparison.h"
#include "core/world/names.h"

namespace tern {
namespace {

using Json = nlohmann::ordered_json;
using Records = std::vector<const FlightRecord*>;

/// Collects the numbers that a chain of member pointers leads to.
template <class... Members>
Distribution over(const Records& records, Members... path) {
  std::vector<double> numbers;
  for (const FlightRecord* r : records) numbers.push_back((*r.*....*path));
  return describe(std::move(numbers));
}

void count_outcomes(CampaignSummary& s, const Records& all) {
  for (const FlightRecord* r : all) {
    switch (r->result.outcome) {
      case FlightOutcome::Reached: ++s.reached; break;
      case FlightOutcome::Collision: ++s.collisions; break;
      case FlightOutcome::Timeout: ++s.timeouts; break;
      case FlightOutcome::Failed: ++s.failed; break;
    }
    if (is_success(*r)) {
      ++s.successes;
    } else {
      s.failed_seeds.push_back(r->seed);
    }
    if (!r->audit.empty()) ++s.audits[r->audit];
  }
  s.flights = static_cast<std::int64_t>(all.size());
}

void add_counts(CampaignSummary& s, const Records& all) {
  std::vector<double> obstacles;
  std::int64_t moving = 0;
  for (const FlightRecord* r : all) {
    s.stops += r->result.stops;
    s.flights_with_stops += r->result.stops > 0 ? 1 : 0;
    s.limit_violations += r->result.limit_violations;
    s.contacts_moving += r->result.contacts_moving;
    s.contacts_at_rest += r->result.contacts_at_rest;
    s.obstacles_left_out += r->result.obstacles_left_out;
    obstacles.push_back(static_cast<double>(r->result.obstacles));
    moving += r->result.contacts_moving > 0 ? 1 : 0;
    s.requests += r->requests;
    s.deadlines_missed += r->requests - r->answered_in_time;
    s.answers_refused += r->answers_refused;
    for (std::size_t k = 0; k < kPlanOutcomes; ++k) s.plans[key(static_cast<PlanOutcome>(k))] += r->plans[k];
  }
  s.obstacles = describe(std::move(obstacles));
  if (s.different < s.flights) return;
  s.success_ci95 = wilson_interval(s.successes, s.flights);
  s.contact_moving_ci95 = wilson_interval(moving, s.flights);
}

void add_measures(CampaignSummary& s, const Records& all, const Records& reached) {
  constexpr auto kResult = &FlightRecord::result;
  s.flight_time_s = over(reached, kResult, &FlightResult::flight_time_s);
  s.first_entry_s = over(reached, kResult, &FlightResult::first_entry_s);
  s.path_length_m = over(reached, kResult, &FlightResult::path_length_m);
  s.mean_speed_mps = over(reached, kResult, &FlightResult::mean_speed_mps);
  s.jerk_integral = over(reached, kResult, &FlightResult::jerk_integral);
  s.top_speed_mps = over(all, kResult, &FlightResult::top_speed_mps);
  s.min_clearance_m = over(all, kResult, &FlightResult::min_clearance_m);
  s.min_map_clearance_m = over(all, kResult, &FlightResult::min_map_clearance_m);
  s.passively_safe_share = over(all, &FlightRecord::passively_safe_share);
  constexpr auto kTracking = &FlightRecord::tracking;
  s.tracking_rmse_m = over(all, kTracking, &Tracking::rmse_m);
  s.tracking_error_m = over(all, kTracking, &Tracking::error_m);
  s.tube_m = over(all, kTracking, &Tracking::tube_m);
  s.tube_margin_m = over(all, kTracking, &Tracking::margin_m);
}

void add_exposure(CampaignSummary& s, const Records& all) {
  struct Numbers {
    std::vector<double> seconds, metres, near_seconds, near_metres;
  };
  std::map<std::string, Numbers> regions;
  for (const FlightRecord* r : all) {
    for (const Exposure& e : r->result.exposure) {
      Numbers& n = regions[e.region];
      n.seconds.push_back(e.seconds), n.metres.push_back(e.metres);
      n.near_seconds.push_back(e.near_seconds), n.near_metres.push_back(e.near_metres);
    }
  }
  for (auto& [region, n] : regions) {
    s.exposure[region] = {describe(std::move(n.seconds)), describe(std::move(n.metres)),
                          describe(std::move(n.near_seconds)), describe(std::move(n.near_metres))};
  }
}

void add_times(CampaignSummary& s, const Flights& flights) {
  std::array<LogHistogram, kMeasuredTimes.size()> sums;
  std::set<std::string> machines, compilers;
  for (const auto& [seed, one] : flights.times) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].merge(one.times[k]);
    machines.insert(one.machine);
    compilers.insert(one.compiler);
  }
  for (std::size_t k = 0; k < sums.size(); ++k) s.times[k] = sums[k].describe();
  s.timed_flights = static_cast<std::int64_t>(flights.times.size());
  s.machines.assign(machines.begin(), machines.end());
  s.compilers.assign(compilers.begin(), compilers.end());
}

void add_coverage(CampaignSummary& s, const Records& all) {
  std::vector<Coverage> flights;
  for (const FlightRecord* r : all) {
    if (!r->coverage.intervals.empty()) flights.push_back(r->coverage);
  }
  s.coverage = coverage_shares(flights);
}

/// Six decimals: micrometres, or nanoseconds of a time in milliseconds.
Json to_json(const Distribution& d) {
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
  return {{"mean", rounded(d.mean)}, {"p50", rounded(d.p50)}, {"p95", rounded(d.p95)},
          {"p99", rounded(d.p99)},   {"min", rounded(d.min)}, {"max", rounded(d.max)}};
}

Json to_json(const std::optional<Interval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json(nullptr);
}

Json exposure_json(const CampaignSummary& s) {
  Json regions = Json::object();
  for (const auto& [region, e] : s.exposure) {
    regions[region] = {{"seconds", to_json(e.seconds)},
                       {"metres", to_json(e.metres)},
                       {"near_seconds", to_json(e.near_seconds)},
                       {"near_metres", to_json(e.near_metres)}};
  }
  return regions;
}

void add_tracking(Json& json, const CampaignSummary& s) {
  json["tracking_rmse_m"] = to_json(s.tracking_rmse_m);
  json["tracking_error_m"] = to_json(s.tracking_error_m);
  json["tube_m"] = to_json(s.tube_m);
  json["tube_margin_m"] = to_json(s.tube_margin_m);
}

Json coverage_json(const CampaignSummary& s) {
  Json shares = Json::array();
  for (const CoverageShare& k : s.coverage) {
    shares.push_back({{"what", k.what},
                      {"horizon", k.horizon},
                      {"promised", k.confidence},
                      {"flights", k.groups},
                      {"made", k.made},
                      {"kept", k.covered},
                      {"share", k.share()},
                      {"ci95", {k.interval.low, k.interval.high}},
                      {"broken", k.is_refuted()},
                      {"half_m", std::isfinite(k.half_m) ? Json(k.half_m) : Json(nullptr)}});
  }
  return shares;
}

/// Returns the interval of the success rate, or why there is none.
std::string in_words(const CampaignSummary& s) {
  if (s.success_ci95)
    return fmt::format(" [{:.2f}, {:.2f}]", 100.0 * s.success_ci95->low, 100.0 * s.success_ci95->high);
  return fmt::format(" (no interval: they are {} different flights)", s.different);
}

/// Returns how many flights were audited, and with which result.
std::string audit_line(const CampaignSummary& s) {
  if (s.audits.empty()) return "";
  std::int64_t audited = 0;
  std::string text;
  for (const auto& [verdict, n] : s.audits) {
    text += fmt::format(", {} {}", n, verdict);
    audited += n;
  }
  text = fmt::format("  audited {} of {}{}\n", audited, s.flights, text);
  if (audited == s.flights) return text;
  return text + fmt::format("    {} were flown earlier without --audit\n", s.flights - audited);
}

}  // namespace

CampaignSummary summarize(const Flights& flights) {
  CampaignSummary s;
  Records all, reached;
  for (const auto& [seed, record] : flights.records) {
    all.push_back(&record);
    if (record.result.outcome == FlightOutcome::Reached) reached.push_back(&record);
  }
  if (!all.empty()) s.identity = all.front()->identity;
  s.different = different_flights(flights.records);
  count_outcomes(s, all);
  add_counts(s, all);
  add_measures(s, all, reached);
  add_exposure(s, all);
  add_times(s, flights);
  add_coverage(s, all);
  return s;
}

std::string to_json(const CampaignSummary& s, const std::string& command) {
  const double rate = s.flights > 0 ? static_cast<double>(s.successes) / static_cast<double>(s.flights) : 0.0;
  Json json = {
      {"scenario", s.identity.scenario},
      {"count", s.identity.count},
      {"charge", s.identity.charge},
      {"flights", s.flights},
      {"reached", s.reached},
      {"collisions", s.collisions},
      {"timeouts", s.timeouts},
      {"failed", s.failed},
      {"success", s.flights > 0 ? Json(rate) : Json(nullptr)},
      {"different_flights", s.different},
      {"success_ci95", to_json(s.success_ci95)},
      {"flight_time_s", to_json(s.flight_time_s)},
      {"first_entry_s", to_json(s.first_entry_s)},
      {"path_length_m", to_json(s.path_length_m)},
      {"mean_speed_mps", to_json(s.mean_speed_mps)},
      {"top_speed_mps", to_json(s.top_speed_mps)},
      {"min_clearance_m", to_json(s.min_clearance_m)},
      {"min_map_clearance_m", to_json(s.min_map_clearance_m)},
      {"jerk_integral", to_json(s.jerk_integral)},
      {"stops", s.stops},
      {"flights_with_stops", s.flights_with_stops},
      {"limit_violations", s.limit_violations},
      {"contacts_moving", s.contacts_moving},
      {"contact_moving_ci95", to_json(s.contact_moving_ci95)},
      {"contacts_at_rest", s.contacts_at_rest},
      {"obstacles", to_json(s.obstacles)},
      {"obstacles_left_out", s.obstacles_left_out},
      {"requests", s.requests},
      {"deadlines_missed", s.deadlines_missed},
      {"answers_refused", s.answers_refused},
      {"plans", s.plans},
      {"timed_flights", s.timed_flights},
  };
  for (std::size_t k = 0; k < kMeasuredTimes.size(); ++k) json[kMeasuredTimes[k]] = to_json(s.times[k]);
  json["passively_safe_share"] = to_json(s.passively_safe_share);
  add_tracking(json, s);
  json["exposure"] = exposure_json(s);
  json["audits"] = s.audits;
  json["coverage"] = coverage_json(s);
  json["failed_seeds"] = s.failed_seeds;
  json["configuration"] = s.identity.configuration;
  json["version"] = s.identity.version;
  json["compiler"] = s.compilers;
  json["machine"] = s.machines;
  json["command"] = command;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const CampaignSummary& s) {
  const double rate = s.flights > 0 ? 100.0 * static_cast<double>(s.successes) / static_cast<double>(s.flights) : 0.0;
  std::string text =
      fmt::format("{}{}: {} flights, success {:.2f} %{}\n", s.identity.scenario,
                  s.identity.count > 0 ? fmt::format(" {}", s.identity.count) : "", s.flights, rate, in_words(s));
  text += fmt::format("  reached {}, collisions {} ({} while moving, {} at rest), timeouts {}, failed {}\n", s.reached,
                      s.collisions, s.contacts_moving, s.contacts_at_rest, s.timeouts, s.failed);
  text += fmt::format(
      "  obstacles in a flight {:.0f} to {:.0f}, mean {:.1f}; {} left out (they started too near to the vehicle)\n",
      s.obstacles.min, s.obstacles.max, s.obstacles.mean, s.obstacles_left_out);
  text += fmt::format("  {:<20}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "", "mean", "p50", "p95", "p99", "min", "max");
  const auto row = [&](const char* name, const Distribution& d) {
    if (d.count == 0) return;
    text += fmt::format("  {:<20}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}{:>12.3f}\n", name, d.mean, d.p50, d.p95,
                        d.p99, d.min, d.max);
  };
  row("flight_time_s", s.flight_time_s), row("first_entry_s", s.first_entry_s);
  row("mean_speed_mps", s.mean_speed_mps), row("top_speed_mps", s.top_speed_mps);
  row("min_clearance_m", s.min_clearance_m), row("min_map_clearance_m", s.min_map_clearance_m);
  row("jerk_integral", s.jerk_integral);
  row("passively_safe_share", s.passively_safe_share);
  row("tracking_rmse_m", s.tracking_rmse_m), row("tracking_error_m", s.tracking_error_m);
  row("tube_m", s.tube_m), row("tube_margin_m", s.tube_margin_m);
  for (std::size_t k = 0; k < kMeasuredTimes.size(); ++k) row(kMeasuredTimes[k], s.times[k]);
  for (const auto& [region, e] : s.exposure) row(fmt::format("{} m", region).c_str(), e.metres);
  text += fmt::format("  stops {} in {} flights, limit violations {}, requests {}, deadlines missed {}\n", s.stops,
                      s.flights_with_stops, s.limit_violations, s.requests, s.deadlines_missed);
  text += audit_line(s);
  text += to_text(s.coverage);
  if (!s.failed_seeds.empty()) text += fmt::format("  failed seeds: {}\n", fmt::join(s.failed_seeds, " "));
  return text;
}

}  // namespace tern
