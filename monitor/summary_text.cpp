#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "core/world/names.h"
#include "core/world/stated_bound.h"
#include "monitor/flight_summary.h"

namespace tern {
namespace {

/// Most channels listed: those with lost or refused messages.
constexpr int kTroubledChannels = 6;
constexpr std::size_t kListedReasons = 4;
constexpr std::size_t kColumns = 100;

/// The text after a heading, in lines of at most kColumns; "" without a text.
std::string wrapped(std::string_view heading, std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t room = kColumns - heading.size();
    std::size_t end = text.size() <= room ? text.size() : text.rfind(' ', room);
    if (end == std::string_view::npos || end == 0) end = std::min(room, text.size());
    lines += fmt::format("{:<{}}{}\n", lines.empty() ? heading : "", heading.size(), text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The number with its unit, or a dash when there is none.
std::string value(double x, std::string_view unit, int digits = 2) {
  return std::isnan(x) ? "-" : fmt::format("{:.{}f} {}", x, digits, unit);
}

std::string row(std::string_view name, const Percentiles& p) {
  if (std::isnan(p.p50)) return fmt::format("  {:<14}{:>9}{:>9}{:>9}{:>9}\n", name, "-", "-", "-", "-");
  return fmt::format("  {:<14}{:>9.2f}{:>9.2f}{:>9.2f}{:>9.2f}\n", name, p.p50, p.p95, p.p99, p.max);
}

/// The obstacles that the referee counted; "" without a result.
std::string obstacles_met(const FlightSummary& s) {
  if (!s.result) return "";
  std::string text = fmt::format(", {} obstacles", s.result->obstacles);
  if (!std::isnan(s.result->min_map_clearance_m)) text += " and a map's walls";
  if (s.result->obstacles_left_out > 0) {
    text += fmt::format(" ({} left out: they began beside the vehicle)", s.result->obstacles_left_out);
  }
  return text;
}

/// One number if all axes have the same value.
std::string per_axis(const Vec3& v) {
  if (v.x() == v.y() && v.x() == v.z()) return std::isinf(v.x()) ? "none" : fmt::format("{:g}", v.x());
  return fmt::format("({:g}, {:g}, {:g})", v.x(), v.y(), v.z());
}

std::string settings_line(const FlownSettings& s) {
  return fmt::format("  flown with    λ {:g} to, {:g} away; v_max {}, a_max {}, j_max {} (SI)\n", s.lambda_attractive,
                     s.lambda_repulsive, per_axis(s.limits.v_max), per_axis(s.limits.a_max), per_axis(s.limits.j_max));
}

std::string flight_lines(const FlightResult& r) {
  std::string text;
  text +=
      fmt::format("  flight time   {:<14} first entry  {}\n", value(r.flight_time_s, "s"), value(r.first_entry_s, "s"));
  text += fmt::format("  path          {:<14} mean speed   {:<14} top speed  {}\n", value(r.path_length_m, "m"),
                      value(r.mean_speed_mps, "m/s"), value(r.top_speed_mps, "m/s"));
  text +=
      fmt::format("  clearance     {:<14} of the map   {:<14} stops      {}, limit violations {}\n",
                  value(r.min_clearance_m, "m", 3), value(r.min_map_clearance_m, "m", 3), r.stops, r.limit_violations);
  if (r.contacts_moving + r.contacts_at_rest > 0) {
    text += fmt::format("  contacts      {} while moving, {} at rest\n", r.contacts_moving, r.contacts_at_rest);
  }
  for (const Exposure& e : r.exposure) {
    text += fmt::format("  in {:<20.20} {:>8} {:>10}   within 1 m {:>8} {:>10}\n", e.region, value(e.seconds, "s"),
                        value(e.metres, "m"), value(e.near_seconds, "s"), value(e.near_metres, "m"));
  }
  return text;
}

/// The most frequent reasons of plans; "" if there were none.
std::string reason_line(const FlightSummary& s) {
  std::vector<std::pair<std::int64_t, PlanReason>> reasons;
  for (int k = 1; k < kPlanReasons; ++k) {
    const std::int64_t count = s.reasons[idx(k)];
    if (count > 0) reasons.emplace_back(count, static_cast<PlanReason>(k));
  }
  if (reasons.empty()) return "";
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text = "  because      ";
  for (std::size_t k = 0; k < std::min(reasons.size(), kListedReasons); ++k) {
    text += fmt::format("{} {} {}", k == 0 ? "" : ",", reasons[k].first, to_string(reasons[k].second));
  }
  return text + (reasons.size() > kListedReasons ? ", …\n" : "\n");
}

std::string plan_lines(const FlightSummary& s) {
  std::string text = fmt::format("  requests      {} settled, {} answered in time", s.requests, s.answered_in_time);
  if (s.second_answers > 0) text += fmt::format("; {} second answers: are there two planners?", s.second_answers);
  text += "\n  plans        ";
  for (int k = 0; k < kPlanOutcomes; ++k) {
    text += fmt::format(" {} {}", s.plans[idx(k)], key(static_cast<PlanOutcome>(k)));
    if (k + 1 < kPlanOutcomes) text += ",";
  }
  text += "\n" + reason_line(s);
  const std::int64_t less = std::accumulate(s.by_level.begin() + 1, s.by_level.end(), std::int64_t{0});
  if (less > 0 || s.for_a_time > 0) {
    text += fmt::format("  confidence    {} at full confidence, {} at less, {} below {}; {} for a limited time\n",
                        s.by_level.front(), less - s.by_level.back(), s.by_level.back(), kConfidenceLevels.back(),
                        s.for_a_time);
  }
  if (s.passively_safe_share) {
    text += fmt::format("  unseen movers {:.1f} % of the time certified\n", *s.passively_safe_share * 100.0);
  }
  if (s.left_out.plans == 0) return text;
  return text +
         fmt::format("  left out      {} plans rest on incomplete predictions: up to {} tracks are not in them\n",
                     s.left_out.plans, s.left_out.max_tracks);
}

/// Empty without an answer.
std::string time_lines(const FlightSummary& s) {
  if (s.requests == 0) return "";
  const std::string slowed = s.pace == 1.0 ? "" : fmt::format("   by the system's clock, at a pace of {:g}", s.pace);
  return fmt::format("  replan, ms    {:>9}{:>9}{:>9}{:>9}{}\n", "p50", "p95", "p99", "max", slowed) +
         row("total", s.replan_ms.total) + row("first answer", s.replan_ms.first_answer) +
         row("broad phase", s.replan_ms.hulls) + row("search", s.replan_ms.search) +
         row("optimization", s.replan_ms.optimization) + row("check", s.replan_ms.check);
}

std::string message_lines(const FlightSummary& s) {
  MessageCount all;
  std::string troubled;
  int listed = 0;
  for (const auto& [channel, count] : s.messages) {
    all.received += count.received;
    all.rejected += count.rejected;
    all.lost += count.lost;
    if ((count.rejected > 0 || count.lost > 0) && listed++ < kTroubledChannels) {
      troubled += fmt::format("    {:<22} {} rejected, {} lost\n", channel, count.rejected, count.lost);
    }
  }
  return fmt::format("  messages      {} received, {} rejected, {} lost\n", all.received, all.rejected, all.lost) +
         troubled;
}

/// Outcome and detail. "reached as believed" says more than the referee's "timeout".
std::string headline(const FlightSummary& s) {
  if (s.detail.starts_with(kReachedAsBelieved)) return s.detail;
  return fmt::format("{}{}{}", to_string(s.outcome), s.detail.empty() ? "" : ": ", s.detail);
}

}  // namespace

int exit_code(const FlightSummary& s) {
  const bool is_whole = !s.recording || s.recording->empty();
  return s.outcome == FlightOutcome::Reached && !is_whole ? kExitIncomplete : static_cast<int>(s.outcome);
}

std::string to_text(const FlightSummary& s) {
  std::string text = headline(s);
  text += "\n" + wrapped("  why           ", s.explanation.sentence);
  if (s.recording && !s.recording->empty()) text += wrapped("  recording     ", "incomplete: " + *s.recording);
  for (const auto& [process, words] : s.said)
    text += wrapped("  said          ", fmt::format("{}: {}", process, words));
  text += fmt::format("  scenario      {}, seed {}{}\n", s.scenario, s.seed.value_or(0), obstacles_met(s));
  if (s.settings) text += settings_line(*s.settings);
  if (s.result) text += flight_lines(*s.result);
  text += plan_lines(s);
  text += time_lines(s) + message_lines(s);
  text += fmt::format("  restarts      {}\n", s.restarts);
  for (const auto& [process, number] : s.concurrent) text += fmt::format("  concurrent    {} {}\n", number, process);
  if (!s.log.empty()) text += fmt::format("  log           {}\n", s.log);
  return text + fmt::format("  version       {}\n", s.version);
}

}  // namespace tern
