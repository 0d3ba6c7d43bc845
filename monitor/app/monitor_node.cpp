#include "monitor/app/monitor_node.h"

#include <spdlog/spdlog.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "messages/configuration_report.h"
#include "messages/flight_result.h"
#include "messages/goal.h"
#include "messages/heartbeat.h"
#include "messages/horizon_request.h"
#include "messages/obstacle_truth.h"
#include "messages/plan.h"
#include "messages/plan_timing.h"
#include "messages/uav_state.h"
#include "monitor/live_line.h"
#include "runtime/channels.h"
#include "runtime/version.h"

namespace tern {
namespace {

constexpr Duration kLookPeriod{100'000};

}  // namespace

MonitorNode::MonitorNode(Bus& bus, const Scenario& scenario, MonitorOptions options)
    : bus_(bus),
      options_(std::move(options)),
      watch_(scenario, bus.clock().now()),
      next_look_(bus.clock().now()),
      next_line_(next_look_ + output_.period()) {
  subscribe();
}

void MonitorNode::subscribe() {
  const Clock& clock = bus_.clock();
  bus_.subscribe<Heartbeat>(channels::kHeartbeat, [&](const Heartbeat& m) { watch_.hear(m, clock.now()); });
  bus_.subscribe<UavState>(channels::kUavState, [&](const UavState& m) { watch_.hear(m); });
  bus_.subscribe<Goal>(channels::kGoal, [&](const Goal& m) { watch_.hear(m); });
  bus_.subscribe<HorizonRequest>(channels::kHorizonRequest,
                                 [&](const HorizonRequest& m) { watch_.hear(m, clock.now()); });
  bus_.subscribe<Plan>(channels::kPlan, [&](const Plan& m) { watch_.hear(m); });
  bus_.subscribe<PlanTiming>(channels::kPlanTiming, [&](const PlanTiming& m) { watch_.hear(m); });
  bus_.subscribe<FlightResult>(channels::kFlightResult, [&](const FlightResult& m) { watch_.hear(m, clock.now()); });
  bus_.subscribe<ObstacleTruth>(channels::kObstacleTruth, [this](const ObstacleTruth& m) {
    const auto batches = truth_.add(m);
    if (!batches) return;
    std::vector<TrueObstacle> obstacles;
    for (const ObstacleTruth& batch : *batches) {
      obstacles.insert(obstacles.end(), batch.obstacles.begin(), batch.obstacles.end());
    }
    watch_.hear(std::move(obstacles));
  });
  // Nothing to learn from these but whether they arrive.
  bus_.subscribe<UavState>(channels::kSetpoint, [](const UavState&) {});
  bus_.subscribe<ConfigurationReport>(channels::kConfiguration, [](const ConfigurationReport&) {});
}

void MonitorNode::step(UTime now) {
  if (now < next_look_ || exit_code_) return;
  next_look_ = now + kLookPeriod;
  look_for_failure();
  if (const auto ending = watch_.ending(now)) return finish(*ending);
  if (now >= next_line_) {
    output_.show(live_line(watch_.live()));
    next_line_ = now + output_.period();
  }
}

void MonitorNode::look_for_failure() {
  if (options_.failure_file.empty()) return;
  std::ifstream file(options_.failure_file);
  if (!file) return;
  std::string text{std::istreambuf_iterator<char>(file), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  watch_.fail(text.empty() ? "the launcher gave up" : text);
}

void MonitorNode::finish(const Ending& ending) {
  FlightSummary summary = watch_.summary(ending);
  summary.log = options_.log;
  summary.version = build_id();
  output_.print(to_text(summary));
  exit_code_ = static_cast<int>(summary.outcome);
  if (options_.summary_file.empty()) return;
  std::ofstream file(options_.summary_file);
  file << to_json(summary);
  if (!file.flush()) spdlog::error("{}: the summary cannot be written", options_.summary_file);
}

}  // namespace tern
