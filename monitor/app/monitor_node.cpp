#include "monitor/app/monitor_node.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/base/files.h"
#include "core/world/box_cover.h"
#include "messages/codec.h"
#include "monitor/app/subscribe_flight.h"
#include "monitor/live_line.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "runtime/timed_scenario.h"
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
  watch_.set_pace(Duration{1'000'000}.seconds() / bus.clock().in_system_time(Duration{1'000'000}).seconds());
  check_summary_file();
  subscribe();
}

/// Checks before the flight that the summary can be written after it.
void MonitorNode::check_summary_file() const {
  const std::string& path = options_.summary_file;
  if (path.empty()) return;
  const bool was_there = std::filesystem::exists(path);
  if (!std::ofstream(path, std::ios::app)) throw ConfigError(path + ": the summary cannot be written");
  if (!was_there) std::filesystem::remove(path);
}

void MonitorNode::subscribe() {
  subscribe_flight(bus_, watch_);
  bus_.subscribe(channels::kObstacleTruth, [this](const ObstacleTruth& m) {
    const auto batches = truth_.add(m);
    if (!batches) return;
    std::vector<TrueObstacle> obstacles;
    for (const ObstacleTruth& batch : *batches) {
      obstacles.insert(obstacles.end(), batch.obstacles.begin(), batch.obstacles.end());
    }
    watch_.receive(std::move(obstacles));
  });
  bus_.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) {
    const Result<bool> complete = map_.add(chunk);
    if (complete && *complete) watch_.receive_map(cover_with_boxes(map_.take(), false));
  });
  // These are only counted.
  bus_.subscribe(channels::kSetpoint, [](const UavState&) {});
  bus_.subscribe(channels::kVehicleTruth, [](const UavState&) {});
}

void MonitorNode::step(UTime now) {
  if (now < next_look_ || exit_code_) return;
  next_look_ = now + kLookPeriod;
  look_for_failure();
  if (const auto ending = watch_.ending(now)) return finish(*ending);
  if (now >= next_line_) {
    output_.show(live_line(watch_.live(), output_.columns()));
    next_line_ = now + output_.period();
  }
}

void MonitorNode::look_for_failure() {
  if (options_.failure_file.empty()) return;
  std::ifstream file(options_.failure_file);
  if (!file) return;
  std::string text{std::istreambuf_iterator<char>(file), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  watch_.fail(text.empty() ? "the launcher ended the flight and gave no reason" : text);
}

void MonitorNode::finish(const Ending& ending) {
  FlightSummary summary = watch_.summary(ending);
  summary.log = options_.log;
  summary.command = options_.command;
  summary.version = build_id();
  const auto estimate = watch_.estimate();
  output_.print(to_text(summary) + (estimate ? to_text(*estimate) : ""));
  exit_code_ = exit_code(summary);
  const std::string json = estimate ? with_estimate(to_json(summary), *estimate) : to_json(summary);
  if (options_.summary_file.empty() || write_text(options_.summary_file, json)) return;
  // The process's own log may be on the same full disk.
  output_.print(options_.summary_file + ": the summary could not be written as a whole\n");
  if (exit_code_ == 0) exit_code_ = kExitIncomplete;
}

std::unique_ptr<MonitorNode> make_monitor(ProcessContext& context, const MonitorOptions& options) {
  const Scenario scenario = timed(context.scenario, read_goals_from(context.document));
  return std::make_unique<MonitorNode>(context.bus, scenario, options);
}

}  // namespace tern
