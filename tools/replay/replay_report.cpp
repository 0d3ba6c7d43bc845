#include "tools/replay/replay_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/world/names.h"
#include "messages/channels.h"
#include "planner/planner_build.h"
#include "runtime/platform.h"
#include "tools/replay/extract.h"

namespace tern {
namespace {

constexpr const char* kAgreements[] = {"identical", "equivalent", "different"};
constexpr const char* kRefusals[kRejections] = {
    "of a wrong length",          "of another version",      "with a count out of range",  "with a number out of range",
    "with an unknown enumerator", "with times out of order", "that contradict themselves", "from the future",
    "of another sender",          "that came twice",         "without a valid tag"};
/// Most lines about the first difference, and about missing inputs.
constexpr std::size_t kMaxLines = 12;

double seconds_into(const Replay& replay, const RecordedPlan& recorded) {
  return static_cast<double>(recorded.received_us - replay.inputs.log.first_us) * 1e-6;
}

std::string what_the_log_lacks(const Replay& replay) {
  std::string text;
  const LogDamage& damage = replay.inputs.log.damage;
  if (damage.places > 0) {
    text += fmt::format("  damaged in {} place(s), where {} bytes were skipped{}\n", damage.places, damage.bytes,
                        damage.truncated ? "; its end is cut off" : "");
  }
  if (damage.missing > 0) text += fmt::format("  {} messages are missing, as the event numbers show\n", damage.missing);
  for (const std::string& part : replay.inputs.log.missing_parts) {
    text += fmt::format("  its part {} is missing\n", part);
  }
  std::map<std::string, LogChannel> channels = replay.inputs.log.channels;
  for (const auto& [name, channel] : replay.predictions.channels) {
    if (channel.read) channels[name] = channel;
  }
  std::string foreign;
  for (const auto& [name, channel] : channels) {
    if (channel.foreign && name != kLcmSelfTest && name != kExtractMark)
      foreign += fmt::format("{}{} ({})", foreign.empty() ? "" : ", ", name, channel.messages);
    if (channel.lost > 0 && !replay.is_extract())
      text += fmt::format("  {}: {} messages were sent but did not reach the logger\n", name, channel.lost);
    for (int r = 0; r < kRejections; ++r) {
      if (channel.refused[r] > 0) text += fmt::format("  {}: {} messages {}\n", name, channel.refused[r], kRefusals[r]);
    }
  }
  if (const std::int64_t n = replay.answers_before(); n > 0) {
    text += fmt::format("  PLAN: {} answers were published before the first one in the log\n", n);
  }
  if (!foreign.empty()) text += fmt::format("  not Tern's, ignored: {}\n", foreign);
  return text;
}

std::string promise_text(const Replay& replay) {
  std::map<std::string, std::int64_t> reasons;
  for (const ReplayedPlan& p : replay.plans) ++reasons[p.tolerance_reason];
  if (reasons.empty()) return "";
  std::string text;
  for (const auto& [why, count] : reasons) {
    if (why.empty()) {
      text += fmt::format("Promised for {}: the same bytes (planner build {:016x} on the same platform: {})\n", count,
                          planner_build(), platform());
    } else {
      text += fmt::format("Promised for {}: the same outcome, and positions to {:g} m, because {}\n", count,
                          kReplayTolerance, why);
    }
  }
  return text;
}

std::string missing_text(const Replay& replay) {
  std::map<std::string, std::int64_t> missing;
  for (const ReplayedPlan& p : replay.plans) {
    if (!p.missing.empty()) ++missing[p.missing];
  }
  std::string text;
  std::size_t lines = 0;
  for (const auto& [what, count] : missing) {
    if (lines++ == kMaxLines) return text + fmt::format("  … and {} more\n", missing.size() - kMaxLines);
    text += fmt::format("  not in the log: {} (needed by {})\n", what, count);
  }
  return text;
}

/// Returns the first answer that differs by more than is promised, otherwise the first that is not identical.
const ReplayedPlan* first_difference(const Replay& replay) {
  const ReplayedPlan* first = nullptr;
  for (const ReplayedPlan& p : replay.plans) {
    if (!p.missing.empty() || p.difference.agreement == Agreement::Identical) continue;
    if (p.difference.agreement == Agreement::Different || p.tolerance_reason.empty()) return &p;
    if (first == nullptr) first = &p;
  }
  return first;
}

std::string first_difference_text(const Replay& replay) {
  const ReplayedPlan* p = first_difference(replay);
  if (p == nullptr) return "";
  const RecordedPlan& recorded = replay.inputs.plans[p->index];
  std::string text =
      fmt::format("The first that differs: request {}, {:.3f} s into the log, {}", recorded.plan.request_id,
                  seconds_into(replay, recorded), to_string(recorded.plan.outcome));
  if (p->difference.parts.empty()) return text + "; only in its encoding\n";
  text += fmt::format("; first in the stage \"{}\", at most {:.3g} m apart\n", to_string(p->difference.parts[0].stage),
                      p->difference.position_m);
  for (std::size_t k = 0; k < std::min(p->difference.parts.size(), kMaxLines); ++k) {
    const PartDifference& part = p->difference.parts[k];
    text += fmt::format("  {:<13} {}\n", to_string(part.stage), part.what);
  }
  return text;
}

std::string changes_text(const Replay& replay) {
  std::map<std::pair<PlanOutcome, PlanOutcome>, std::int64_t> outcomes;
  double largest = 0.0;
  double sum = 0.0;
  std::int64_t moved = 0;
  for (const ReplayedPlan& p : replay.plans) {
    if (!p.missing.empty()) continue;
    ++outcomes[{replay.inputs.plans[p.index].plan.outcome, p.outcome}];
    if (p.difference.position_m == 0.0) continue;
    ++moved;
    sum += p.difference.position_m;
    largest = std::max(largest, p.difference.position_m);
  }
  std::string text = "With the changed settings, on the recorded requests and with the recorded counts:\n";
  for (const auto& [change, count] : outcomes) {
    const auto [before, after] = change;
    text += before == after ? fmt::format("  {:>6}  {} as before\n", count, to_string(before))
                            : fmt::format("  {:>6}  {} instead of {}\n", count, to_string(after), to_string(before));
  }
  const double mean = moved > 0 ? sum / static_cast<double>(moved) : 0.0;
  return text + fmt::format("  {:>6}  other trajectories, at most {:.3g} m from the recorded ones (mean {:.3g} m)\n",
                            moved, largest, mean);
}

}  // namespace

std::string replay_text(const Replay& replay, bool what_if) {
  const LogContents& log = replay.inputs.log;
  std::set<std::int64_t> planners;
  for (const RecordedPlan& p : replay.inputs.plans) planners.insert(p.plan.header.name.sender_epoch_us);
  std::string text = fmt::format(
      "{}: {} messages, {:.1f} s, {} answers of {} planner process(es)\n", log.parts.empty() ? "inputs" : log.parts[0],
      log.events, static_cast<double>(log.last_us - log.first_us) * 1e-6, replay.inputs.plans.size(), planners.size());
  text += what_the_log_lacks(replay);
  if (!what_if) text += promise_text(replay);
  text += missing_text(replay);
  if (replay.inputs.plans.empty()) text += "  no answers of a planner\n";
  const std::int64_t replayed = static_cast<std::int64_t>(replay.plans.size()) - replay.missing();
  text += fmt::format("{} of {} identical, {} equivalent, {} different, {} not replayed\n",
                      replay.count(Agreement::Identical), replayed, replay.count(Agreement::Equivalent),
                      replay.count(Agreement::Different), replay.missing());
  if (what_if) return text + changes_text(replay);
  return text + first_difference_text(replay);
}

std::string replay_json(const Replay& replay, bool what_if) {
  nlohmann::ordered_json root;
  root["log"] = replay.inputs.log.parts;
  root["what_if"] = what_if;
  root["planner_build"] = fmt::format("{:016x}", planner_build());
  root["platform"] = platform();
  root["answers"] = replay.plans.size();
  root["identical"] = replay.count(Agreement::Identical);
  root["equivalent"] = replay.count(Agreement::Equivalent);
  root["different"] = replay.count(Agreement::Different);
  root["not_replayed"] = replay.missing();
  root["promise_broken"] = replay.unfulfilled();
  root["incomplete"] = replay.incomplete();
  auto& list = root["plans"] = nlohmann::ordered_json::array();
  for (const ReplayedPlan& p : replay.plans) {
    const RecordedPlan& recorded = replay.inputs.plans[p.index];
    nlohmann::ordered_json line;
    line["request"] = recorded.plan.request_id;
    line["planner"] = recorded.plan.header.name.sender_epoch_us;
    line["time_s"] = seconds_into(replay, recorded);
    line["promise"] = p.tolerance_reason.empty() ? "bytes" : "tolerance";
    if (!p.missing.empty()) {
      line["missing"] = p.missing;
    } else {
      line["agreement"] = kAgreements[idx(p.difference.agreement)];
      line["recorded"] = to_string(recorded.plan.outcome);
      line["replayed"] = to_string(p.outcome);
      line["position_m"] = p.difference.position_m;
      for (const PartDifference& part : p.difference.parts) {
        line["differences"].push_back({{"stage", to_string(part.stage)}, {"what", part.what}});
      }
    }
    list.push_back(std::move(line));
  }
  // The log's path need not be UTF-8.
  return root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int replay_exit_code(const Replay& replay, bool what_if) {
  if (!what_if && replay.unfulfilled() > 0) return 1;
  return replay.incomplete() ? 3 : 0;
}

}  // namespace tern
