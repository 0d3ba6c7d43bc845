#include "tools/audit/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

#include "messages/channels.h"

namespace tern::audit {
namespace {

/// The channels that an audit needs. Losses are listed for all channels that it reads.
constexpr std::tuple kNeeded{channels::kUavState,    channels::kSetpoint,    channels::kHorizonRequest,
                             channels::kPlan,        channels::kPredictions, channels::kObstacleTruth,
                             channels::kSemanticMap, channels::kGoal,        channels::kConfiguration};
/// Findings per check in the text.
constexpr std::size_t kFindingsInText = 10;

std::vector<std::string> what_is_missing(const FlightRecord& record) {
  std::vector<std::string> missing;
  const LogContents& log = record.contents;
  if (log.damage.places > 0) {
    missing.push_back(
        fmt::format("the log is damaged in {} places ({} bytes; {} messages are missing, as the event numbers show)",
                    log.damage.places, log.damage.bytes, log.damage.missing));
  }
  if (log.damage.truncated) missing.push_back("the log ends in the middle of an event");
  std::set<MessageName> names;
  for (const HorizonRequest& r : record.requests) names.insert(r.header.name);
  if (names.size() < record.requests.size()) {
    missing.push_back("requests of the same name occur twice: are the log's parts of different flights?");
  }
  const auto look_for = [&](const auto& needed) {
    const auto channel = log.channels.find(needed.name);
    const bool there = channel != log.channels.end() && channel->second.messages > 0;
    if (!there) missing.push_back(fmt::format("no {}", needed.name));
  };
  for_each_channel(look_for, kNeeded);
  // The first message of a latched channel repeats the ones before it.
  const auto is_latched = [](const std::string& name) {
    bool latched = false;
    visit_channel(name, [&latched](const auto& channel) { latched = channel.latched; });
    return latched;
  };
  for (const auto& [name, channel] : log.channels) {
    if (channel.lost > 0)
      missing.push_back(fmt::format("{}: {} messages lost, as the sequence numbers show", name, channel.lost));
    if (channel.before_first > 0 && !is_latched(name)) {
      missing.push_back(fmt::format("{}: the log lacks the first {} messages", name, channel.before_first));
    }
    if (const std::int64_t refused = channel.refused_total(); refused > 0)
      missing.push_back(fmt::format("{}: {} messages refused (damaged, or another version)", name, refused));
  }
  if (!record.requests.empty() && record.requests.front().id > 1) {
    missing.push_back(
        fmt::format("the log begins with request {}: earlier requests are missing", record.requests.front().id));
  }
  return missing;
}

/// Lists missing goals and configurations that plans name. The checks look for requests, predictions and maps.
std::vector<std::string> named_and_missing(const FlightRecord& record) {
  std::map<std::string, std::int64_t> plans;
  for (const Plan& plan : record.plans) {
    const PlanInputs& names = plan.inputs;
    if (names.goal != MessageName{} && !record.goal_names.contains(names.goal)) {
      ++plans[fmt::format("GOAL {} of sender {}", names.goal.sequence, names.goal.sender_epoch_us)];
    }
    if (names.configuration_hash != 0 && !record.configuration_hashes.contains(names.configuration_hash)) {
      ++plans[fmt::format(
          "CONFIGURATION {:016x} of the planner (the defaults of stale_after_s and unknown "
          "are assumed)",
          names.configuration_hash)];
    }
  }
  std::vector<std::string> missing;
  missing.reserve(plans.size());
  for (const auto& [what, n] : plans) missing.push_back(fmt::format("{}: named by {} plans, not in the log", what, n));
  return missing;
}

/// Returns how the referee's collision agrees with the log, for the last line.
std::string words(Collision collision) {
  switch (collision) {
    case Collision::None: return "";
    case Collision::Agrees: return ": the referee saw a collision, and so does the log";
    case Collision::CannotTell: return ", but the referee saw a collision: too close to tell from the log";
    case Collision::Contradicts: return ": the referee saw a collision, but the log contradicts it";
  }
  return "";
}

/// Returns the last line.
std::string verdict_line(const Audit& audit, const FlightRecord& record) {
  switch (audit.verdict()) {
    case Verdict::Broken: return "BROKEN" + words(audit.collision);
    case Verdict::Incomplete:
      return fmt::format("INCOMPLETE: nothing is broken in the part of the flight that the log holds; {}{}",
                         to_text(audit.span), words(audit.collision));
    case Verdict::NotJudged: {
      const bool never = !audit.span.began && audit.span.flight_s.value_or(0.0) == 0.0;
      const std::string why = record.why.empty() ? "the flight never began" : record.why;
      return "NOT JUDGED: " + (never ? why : "the log holds too little of the flight; " + to_text(audit.span));
    }
    default: return to_string(audit.verdict()) + words(audit.collision);
  }
}

/// Returns the obstacle that the vehicle collided with. Empty after a collision with the map, or without a state near
/// enough.
std::optional<Contact> contact_of(const FlightRecord& record, const Audit& audit) {
  if (record.results.empty() || record.results.back().outcome != FlightOutcome::Collision) return std::nullopt;
  const auto touched =
      std::ranges::find_if(audit.clearance, [](const ClearancePoint& p) { return p.clearance_m <= 0.0; });
  if (touched == audit.clearance.end()) return std::nullopt;
  return contact_at(record, touched->at, touched->obstacle);
}

nlohmann::json coverage_json(const Audit& audit) {
  nlohmann::json rows = nlohmann::json::array();
  for (const CoverageShare& s : audit.shares) {
    nlohmann::json row = {{"what", s.what},          {"horizon", s.horizon},    {"promised", s.confidence},
                          {"obstacles", s.groups},   {"made", s.made},          {"kept", s.covered},
                          {"low", s.interval.low},   {"high", s.interval.high}, {"at_most", s.upper_bound},
                          {"broken", s.is_refuted()}};
    if (std::isfinite(s.half_m)) row["half_m"] = s.half_m;
    rows.push_back(std::move(row));
  }
  return rows;
}

nlohmann::json by_age_json(const ByAge& by_age) {
  nlohmann::json rows = nlohmann::json::array();
  for (std::size_t bin = 0; bin < kAgeBins; ++bin) {
    for (std::size_t h = 0; h < kHorizons; ++h) {
      const IntervalCount& count = by_age[bin][h];
      if (count.made == 0) continue;
      const nlohmann::json until = bin < kAges.size() ? nlohmann::json(kAges[bin]) : nlohmann::json();
      rows.push_back({{"until_s", until},
                      {"horizon", horizon_name(h)},
                      {"made", count.made},
                      {"kept", count.covered[0]},
                      {"half_m", count.half_width_sum_m / static_cast<double>(count.made)}});
    }
  }
  return rows;
}

}  // namespace

const char* to_string(Verdict verdict) {
  constexpr std::array kNames{"held", "broken", "not checked", "incomplete", "not judged"};
  return kNames[idx(verdict)];
}

const char* to_string(Collision collision) {
  constexpr std::array kNames{"none", "agrees", "cannot tell", "contradicts"};
  return kNames[idx(collision)];
}

Verdict Audit::verdict() const {
  const auto is = [&](Verdict v) { return [v](const Check& c) { return c.verdict() == v; }; };
  if (std::any_of(checks.begin(), checks.end(), is(Verdict::Broken))) return Verdict::Broken;
  if (!span.began || std::none_of(checks.begin(), checks.end(), is(Verdict::Held))) return Verdict::NotJudged;
  return span.gaps.empty() ? Verdict::Held : Verdict::Incomplete;
}

const Check& Audit::check(const std::string& name) const {
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& c) { return c.name == name; });
  if (found == checks.end()) throw std::out_of_range("no check " + name);
  return *found;
}

Audit audit_flight(const FlightRecord& record) {
  Audit audit;
  audit.span = span_of(record);
  audit.missing = what_is_missing(record);
  for (std::string& what : named_and_missing(record)) audit.missing.push_back(std::move(what));
  audit.missing.insert(audit.missing.end(), record.other_flights.begin(), record.other_flights.end());
  audit.checks.push_back(check_clearance(record, audit));
  audit.checks.push_back(check_map(record, audit));
  audit.checks.push_back(check_limits(record));
  audit.checks.push_back(check_continuity(record));
  audit.checks.push_back(check_commitment(record));
  if (!record.headings.empty()) audit.checks.push_back(check_headings(record));
  if (!record.frames.empty()) audit.checks.push_back(check_unseen(record));
  audit.checks.push_back(check_tube(record, audit));
  audit.checks.push_back(check_certificates(record));
  audit.checks.push_back(check_holds(record));
  audit.checks.push_back(check_answers(record));
  audit.checks.push_back(check_predictions(record, audit));
  audit.checks.push_back(check_exposure(record));
  audit.checks.push_back(check_result(record, audit));
  audit.contact = contact_of(record, audit);
  return audit;
}

std::string to_text(const Audit& audit, const FlightRecord& record) {
  std::string text = fmt::format("Audit of {}: {:.2f} s, {} requests, {} plans\n\n", record.path,
                                 (record.end() - record.zero()).seconds(), record.requests.size(), record.plans.size());
  if (!record.why.empty()) text += fmt::format("Why the goal was not reached: {}\n\n", record.why);
  for (const Check& check : audit.checks) {
    const Verdict verdict = check.verdict();
    text += fmt::format("  {:<12} {:<13} {}\n", verdict == Verdict::Broken ? "BROKEN" : to_string(verdict), check.name,
                        verdict == Verdict::NotChecked || check.summary.empty() ? check.claim : check.summary);
    const std::size_t listed = std::min(check.findings.size(), kFindingsInText);
    for (std::size_t k = 0; k < listed; ++k) {
      const Finding& f = check.findings[k];
      text += fmt::format("      {:>8.3f} s  {}{}\n", record.seconds(f.at),
                          f.request > 0 ? fmt::format("request {}: ", f.request) : "", f.what);
    }
    const auto more = check.broken - static_cast<std::int64_t>(listed);
    if (check.broken > 0 && more > 0) text += fmt::format("      and {} more, of {} checked\n", more, check.checked);
  }
  if (audit.contact) text += "\n" + to_text(*audit.contact, record);
  if (!audit.shares.empty()) text += "\n" + to_text(audit.shares);
  std::string gaps;
  for (const std::string& what : audit.missing) gaps += fmt::format("  {}\n", what);
  for (const Check& check : audit.checks) {
    if (check.verdict() == Verdict::NotChecked && check.unchecked.empty()) gaps += fmt::format("  {}\n", check.name);
    for (const auto& [what, n] : check.unchecked) gaps += fmt::format("  {}: {} ({})\n", check.name, what, n);
  }
  text += gaps.empty() ? "\nNothing was left unchecked.\n" : "\nCould not be checked, or only in part:\n" + gaps;
  if (!audit.span.gaps.empty()) text += "\nNot in the log:\n";
  for (const std::string& gap : audit.span.gaps) text += fmt::format("  {}\n", gap);
  return text + "\n" + verdict_line(audit, record) + "\n";
}

nlohmann::json to_json(const Audit& audit, const FlightRecord& record) {
  nlohmann::json checks = nlohmann::json::array();
  for (const Check& check : audit.checks) {
    nlohmann::json findings = nlohmann::json::array();
    for (const Finding& f : check.findings) {
      nlohmann::json one = {{"time_s", record.seconds(f.at)}, {"what", f.what}};
      if (f.request > 0) one["request"] = f.request;
      if (f.obstacle != kNoObstacle) one["obstacle"] = f.obstacle;
      findings.push_back(std::move(one));
    }
    nlohmann::json measures = nlohmann::json::object();
    for (const auto& [name, value] : check.measures) measures[name] = value;
    checks.push_back({{"name", check.name},
                      {"claim", check.claim},
                      {"verdict", to_string(check.verdict())},
                      {"summary", check.summary},
                      {"checked", check.checked},
                      {"broken", check.broken},
                      {"findings", findings},
                      {"unchecked", check.unchecked},
                      {"measures", measures}});
  }
  nlohmann::json tracks = nlohmann::json::array();
  for (const TrackCoverage& t : audit.tracks) {
    tracks.push_back({{"track", t.track},
                      {"obstacle", t.obstacle},
                      {"promises", t.sets},
                      {"kept", t.covered},
                      {"worst_m", t.worst_m}});
  }
  nlohmann::json all = {
      {"log", record.path},
      {"verdict", to_string(audit.verdict())},
      {"collision", to_string(audit.collision)},
      {"flight_s", (record.end() - record.zero()).seconds()},
      {"why", record.why},
      {"reaches", {{"from_s", audit.span.from_s}, {"to_s", audit.span.to_s}, {"gaps", audit.span.gaps}}},
      {"checks", checks},
      {"missing", audit.missing},
      {"coverage", coverage_json(audit)},
      {"coverage_sums", to_text(audit.coverage)},
      {"by_age", {{"moving", by_age_json(audit.moving_by_age)}, {"at rest", by_age_json(audit.rest_by_age)}}},
      {"tracks", tracks},
      {"confidence", audit.promised_confidence}};
  for (const auto& [id, name] : record.obstacle_names) all["names"][std::to_string(id)] = name;
  if (audit.contact) all["contact"] = to_json(*audit.contact, record);
  return all;
}

}  // namespace tern::audit
