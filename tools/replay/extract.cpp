#include "tools/replay/extract.h"

#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/world/names.h"
#include "flight_log/log_writer.h"
#include "flight_log/text_log.h"
#include "messages/batching.h"
#include "messages/codec.h"

namespace tern {
namespace {

using SetName = std::pair<std::int64_t, std::int64_t>;  // sender epoch, set

SetName set_named_by(const Plan& plan) { return {plan.inputs.predictions.sender_epoch_us, plan.inputs.prediction_set}; }

/// Removes the entries of a map that are not named.
template <class Map, class Keys>
void keep(Map& map, const Keys& keys) {
  std::erase_if(map, [&](const auto& entry) { return !keys.contains(entry.first); });
}

void keep_what_is_named(RecordedInputs& inputs) {
  std::set<MessageName> requests, goals;
  std::set<std::uint64_t> maps, configurations, statics;
  std::set<std::int64_t> planners;
  for (const RecordedPlan& recorded : inputs.plans) {
    const PlanInputs& names = recorded.plan.inputs;
    requests.insert({names.request, names.goal_field.vehicle});
    goals.insert(names.goal);
    maps.insert({names.map_version, names.goal_field.map_version});
    configurations.insert(names.configuration_hash);
    statics.insert(names.goal_field.statics);
    planners.insert(recorded.plan.header.name.sender_epoch_us);
  }
  keep(inputs.requests, requests);
  keep(inputs.goals, goals);
  keep(inputs.maps, maps);
  keep(inputs.configurations, configurations);
  keep(inputs.densities, statics);
  keep(inputs.platforms, planners);
}

/// Returns the needed sets: those that plans name, and those from which a planner took the static tracks that it named.
class NeededSets {
 public:
  explicit NeededSets(const std::vector<RecordedPlan>& plans) {
    for (const RecordedPlan& recorded : plans) {
      const GoalFieldInputs& field = recorded.plan.inputs.goal_field;
      named_.insert(set_named_by(recorded.plan));
      if (field.statics_epoch_us != 0) memories_[{field.statics_epoch_us, field.statics_first_set}];
    }
  }
  bool operator()(const TrackSet& set) {
    const SetName name{set.header.name.sender_epoch_us, set.batch.set};
    bool needed = named_.contains(name);
    for (auto& [from, memory] : memories_) {
      if (from.first == name.first && from.second <= name.second) needed = memory.add(set) || needed;
    }
    return needed;
  }

 private:
  std::set<SetName> named_;
  std::map<SetName, StaticTracks> memories_;
};

/// Writes messages under their own names, at the times of the answers.
class ExtractWriter {
 public:
  using Sink = std::function<void(const LogEvent&)>;
  ExtractWriter(const Extract& extract, Sink sink) : extract_(extract), sink_(std::move(sink)) {
    if (!extract.inputs.plans.empty()) now_us_ = extract.inputs.plans.front().received_us;
    for (const RecordedPlan& recorded : extract.inputs.plans) {
      answers_[set_named_by(recorded.plan)].push_back(&recorded);
    }
  }

  void run() {
    constexpr std::string_view kText = "This log holds only what its answers name.";
    sink_({0, now_us_, kExtractMark, {kText.begin(), kText.end()}});
    write_configurations();
    for (const auto& [version, map] : extract_.inputs.maps) {
      std::int64_t sequence = 0;
      for (MapChunk& chunk : to_chunks(map)) {
        chunk.header.name = {1, ++sequence};
        put(channels::kSemanticMap, chunk);
      }
    }
    for (const auto& [name, goal] : extract_.inputs.goals) put(channels::kGoal, goal);
    for (const auto& [statics, densities] : extract_.inputs.densities) put(channels::kLandmarkDensities, densities);
    write_requests();
    for (const TrackSet& set : extract_.predictions) {
      if (set.pose_error) put(channels::kPoseError, *set.pose_error);
      for (const TrackSet& batch : split_batches(set)) put(channels::kPredictions, batch);
      write_answers({set.header.name.sender_epoch_us, set.batch.set});
    }
    while (!answers_.empty()) write_answers(SetName(answers_.begin()->first));
  }

 private:
  template <class T>
  void put(const Channel<T>& channel, const T& message) {
    sink_({0, now_us_, channel.name, encode(message)});
  }

  /// Requests follow the frames that were there before them, since a field of unseen movers is made from all of those.
  void write_requests() {
    std::multimap<std::size_t, const HorizonRequest*> in_order;
    for (const auto& [name, request] : extract_.inputs.requests) {
      const auto before = extract_.inputs.frames_before.find(name);
      in_order.emplace(before == extract_.inputs.frames_before.end() ? 0 : before->second, &request);
    }
    std::size_t written = 0;
    for (const auto& [frames_before, request] : in_order) {
      for (; written < frames_before; ++written) put(channels::kObstacleSightings, extract_.inputs.frames[written]);
      put(channels::kHorizonRequest, *request);
    }
  }

  /// One per planner process, since the promise depends on the process's platform.
  void write_configurations() {
    std::map<std::int64_t, std::uint64_t> hashes;
    for (const RecordedPlan& recorded : extract_.inputs.plans) {
      hashes[recorded.plan.header.name.sender_epoch_us] = recorded.plan.inputs.configuration_hash;
    }
    for (const auto& [epoch_us, hash] : hashes) {
      const auto report = extract_.inputs.configurations.find(hash);
      if (report == extract_.inputs.configurations.end()) continue;
      ConfigurationReport own = report->second;
      const auto platform = extract_.inputs.platforms.find(epoch_us);
      own.header.name = {epoch_us, 1};
      own.platform = platform == extract_.inputs.platforms.end() ? "" : platform->second;
      put(channels::kConfiguration, own);
    }
  }

  void write_answers(const SetName& name) {
    const auto found = answers_.find(name);
    if (found == answers_.end()) return;
    for (const RecordedPlan* recorded : found->second) {
      now_us_ = recorded->received_us;
      put(channels::kPlan, recorded->plan);
      if (recorded->timing) put(channels::kPlanTiming, *recorded->timing);
      if (recorded->heading) put(channels::kPlanHeading, *recorded->heading);
    }
    answers_.erase(found);
  }

  const Extract& extract_;
  Sink sink_;
  std::int64_t now_us_ = 0;
  std::map<SetName, std::vector<const RecordedPlan*>> answers_;
};

/// Returns the comment of a fixture: its contents in words.
std::string in_words(const Plan& plan, const Extract& extract) {
  std::string text = fmt::format("# request {}: {}", plan.request_id, to_string(plan.outcome));
  if (plan.reason != PlanReason::None) text += fmt::format(" ({})", to_string(plan.reason));
  const auto request = extract.inputs.requests.find(plan.inputs.request);
  if (request != extract.inputs.requests.end()) {
    const MotionSample& s = request->second.start;
    text += fmt::format("; from p ({:.3f}, {:.3f}, {:.3f}) m, v ({:.3f}, {:.3f}, {:.3f}) m/s", s.p.x(), s.p.y(),
                        s.p.z(), s.v.x(), s.v.y(), s.v.z());
  }
  const Vec3& g = plan.local_goal;
  text += fmt::format(" to local goal ({:.3f}, {:.3f}, {:.3f}) m\n", g.x(), g.y(), g.z());
  for (const BudgetCut& cut : plan.cuts) {
    text += fmt::format("#   cut: {} {}, {}, after {}\n", to_string(cut.phase), cut.attempt, to_string(cut.stage),
                        cut.count);
  }
  if (plan.standing) text += fmt::format("#   the watchdog sent answer {}\n", *plan.standing);
  return text;
}

}  // namespace

Result<Extract> extract(const std::string& path, const ReplayOptions& options, int every) {
  auto inputs = read_recorded_inputs(path, options.suffix);
  if (!inputs) return tl::make_unexpected(inputs.error());
  Extract result;
  result.inputs = std::move(*inputs);
  std::vector<RecordedPlan> chosen;
  std::int64_t count = 0;
  for (RecordedPlan& recorded : result.inputs.plans) {
    if (is_chosen(recorded, result.inputs.log, options) && count++ % every == 0) chosen.push_back(std::move(recorded));
  }
  result.inputs.plans = std::move(chosen);
  keep_what_is_named(result.inputs);
  NeededSets is_needed(result.inputs.plans);
  auto read = read_prediction_sets(path, options.suffix, [&](TrackSet set) {
    if (is_needed(set)) result.predictions.push_back(std::move(set));
  });
  if (!read) return tl::make_unexpected(read.error());
  return result;
}

Result<void> write_log(const Extract& extract, const std::string& path) {
  auto writer = LogWriter::open(path, 0);
  if (!writer) return tl::make_unexpected(writer.error());
  if (writer->part_path() != path) return fail(path + ": exists already");
  ExtractWriter(extract, [&writer](const LogEvent& event) {
    writer->append(event.channel, event.received_us, event.data);
  }).run();
  return writer->flush();
}

Result<void> write_fixture(const Extract& extract, const std::string& path) {
  std::ofstream file(path);
  file << kTextLogHead << "\n";
  for (const RecordedPlan& recorded : extract.inputs.plans) file << in_words(recorded.plan, extract);
  ExtractWriter(extract, [&file](const LogEvent& event) { file << text_line(event) << "\n"; }).run();
  if (!file.flush()) return fail(path + ": cannot be written");
  return {};
}

Result<void> write_extract(const std::string& path, const ReplayOptions& options, const std::string& log,
                           const std::string& fixture) {
  if (log.empty() && fixture.empty()) return {};
  const auto chosen = extract(path, options);
  if (!chosen) return tl::make_unexpected(chosen.error());
  const auto written = log.empty() ? Result<void>() : write_log(*chosen, log);
  return fixture.empty() || !written ? written : write_fixture(*chosen, fixture);
}

}  // namespace tern
