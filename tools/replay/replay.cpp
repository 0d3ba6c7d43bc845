#include "tools/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <numeric>
#include <utility>

#include "messages/channels.h"
#include "planner/planner_build.h"
#include "runtime/config.h"
#include "runtime/platform.h"
#include "tools/replay/extract.h"
#include "tools/replay/recorded_problems.h"
#include "tools/replay/replan.h"

namespace tern {
namespace {

/// Plans answers again.
class Replayer {
 public:
  Replayer(const RecordedInputs& inputs, const ReplayOptions& options)
      : inputs_(inputs), has_other_settings_(!options.other.empty()) {}

  /// Plans an answer again. If the planner throws on recorded inputs, that counts as a difference, and the replay goes
  /// on.
  /// @throws ConfigError for what-if settings that the planner refuses
  ReplayedPlan replay_or_say_why(std::size_t index, WorldRebuilder& world) const {
    try {
      return replay(index, world);
    } catch (const std::exception& e) {
      const bool is_users = has_other_settings_ && dynamic_cast<const ConfigError*>(&e) != nullptr;
      if (is_users) throw;
      ReplayedPlan failed;
      failed.index = index;
      failed.tolerance_reason = tolerance_reason(inputs_, inputs_.plans[index].plan);
      failed.difference.agreement = Agreement::Different;
      failed.difference.parts = {{Stage::Fallback, fmt::format("planning it again failed: {}", e.what())}};
      return failed;
    }
  }

 private:
  ReplayedPlan replay(std::size_t index, WorldRebuilder& world) const {
    const RecordedPlan& recorded = inputs_.plans[index];
    ReplayedPlan result;
    result.index = index;
    result.tolerance_reason = tolerance_reason(inputs_, recorded.plan);
    const auto problem = world.problem_of(recorded.plan);
    if (!problem) {
      result.missing = problem.error().message;
      return result;
    }
    const Replanned again = replan(*problem, recorded.plan);
    result.outcome = again.plan.outcome;
    result.difference = difference_of(recorded.plan, again.plan, recorded.timing ? &*recorded.timing : nullptr,
                                      again.statistics ? &*again.statistics : nullptr);
    if (recorded.heading) {
      add_heading(*recorded.heading, replan_heading(*problem, again.plan, *recorded.heading), result.difference);
    }
    return result;
  }

  const RecordedInputs& inputs_;
  bool has_other_settings_;
};

/// @return an Error if the log has answers and none is selected
Result<void> check_choice(const RecordedInputs& inputs, const ReplayOptions& options) {
  const auto chosen = [&](const RecordedPlan& recorded) { return is_chosen(recorded, inputs.log, options); };
  if (inputs.plans.empty() || std::ranges::any_of(inputs.plans, chosen)) return {};
  const auto at_s = [&](const RecordedPlan& p) {
    return static_cast<double>(p.received_us - inputs.log.first_us) * 1e-6;
  };
  const RecordedPlan &first = inputs.plans.front(), &last = inputs.plans.back();
  return fail(
      fmt::format("no answer is selected; the log has answers from {:.3f} s (request {}) to {:.3f} s (request {})",
                  at_s(first), first.plan.request_id, at_s(last), last.plan.request_id));
}

}  // namespace

bool is_chosen(const RecordedPlan& recorded, const LogContents& log, const ReplayOptions& options) {
  const double at_s = static_cast<double>(recorded.received_us - log.first_us) * 1e-6;
  return at_s >= options.from_s.value_or(at_s) && at_s <= options.to_s.value_or(at_s) &&
         recorded.plan.request_id == options.request.value_or(recorded.plan.request_id);
}

std::string tolerance_reason(const RecordedInputs& inputs, const Plan& plan) {
  if (plan.inputs.planner_build != planner_build()) {
    return fmt::format("the planner's build differs (sources, compiler or flags): {:016x}, here {:016x}",
                       plan.inputs.planner_build, planner_build());
  }
  const auto recorded = inputs.platforms.find(plan.header.name.sender_epoch_us);
  if (recorded == inputs.platforms.end()) return "the log does not name the planner's platform";
  if (recorded->second == platform()) return "";
  return fmt::format("another platform: {}; here {}", recorded->second, platform());
}

std::int64_t Replay::count(Agreement agreement) const {
  return std::ranges::count_if(
      plans, [agreement](const ReplayedPlan& p) { return p.missing.empty() && p.difference.agreement == agreement; });
}

std::int64_t Replay::missing() const {
  return std::ranges::count_if(plans, [](const ReplayedPlan& p) { return !p.missing.empty(); });
}

std::int64_t Replay::unfulfilled() const {
  return std::ranges::count_if(plans, [](const ReplayedPlan& p) {
    if (!p.missing.empty() || p.difference.agreement == Agreement::Identical) return false;
    return p.tolerance_reason.empty() || p.difference.agreement == Agreement::Different;
  });
}

bool Replay::is_extract() const { return inputs.log.channels.contains(kExtractMark); }

std::int64_t Replay::answers_before() const {
  if (is_extract()) return 0;
  std::map<std::int64_t, std::int64_t> first;  ///< by planner
  for (const RecordedPlan& p : inputs.plans) {
    const MessageName& name = p.plan.header.name;
    const auto [known, is_new] = first.try_emplace(name.sender_epoch_us, name.sequence);
    if (!is_new) known->second = std::min(known->second, name.sequence);
  }
  return std::accumulate(first.begin(), first.end(), std::int64_t{0}, [](std::int64_t sum, const auto& planner) {
    return sum + std::max<std::int64_t>(0, planner.second - 1);
  });
}

bool Replay::incomplete() const {
  const LogDamage& damage = inputs.log.damage;
  const auto answers = inputs.log.channels.find(channels::kPlan.name + suffix);
  const bool known = answers != inputs.log.channels.end();
  return missing() > 0 || answers_before() > 0 || inputs.plans.empty() || damage.places > 0 || damage.missing > 0 ||
         !inputs.log.missing_parts.empty() || (known && answers->second.lost > 0 && !is_extract()) ||
         (known && answers->second.refused_total() > 0);
}

Result<Replay> replay_log(const std::string& path, const ReplayOptions& options) {
  options.other.check();
  auto inputs = read_recorded_inputs(path, options.suffix);
  if (!inputs) return tl::make_unexpected(inputs.error());
  if (inputs->log.events == 0) return fail(path + ": holds no complete message");
  if (auto chosen = check_choice(*inputs, options); !chosen) return tl::make_unexpected(chosen.error());
  Replay replay;
  const Replayer replayer(*inputs, options);
  auto predictions = visit_answers(path, *inputs, options, [&](std::size_t index, WorldRebuilder& world) {
    replay.plans.push_back(replayer.replay_or_say_why(index, world));
  });
  if (!predictions) return tl::make_unexpected(predictions.error());
  std::ranges::sort(replay.plans, [](const auto& a, const auto& b) { return a.index < b.index; });
  replay.suffix = options.suffix;
  replay.predictions = std::move(*predictions);
  replay.inputs = std::move(*inputs);
  return replay;
}

}  // namespace tern
