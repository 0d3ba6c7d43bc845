#include "tools/audit/flight_record.h"

#include <algorithm>
#include <utility>

#include "messages/batching.h"
#include "messages/configuration_report.h"
#include "messages/flight_result.h"
#include "messages/goal.h"
#include "messages/horizon_request.h"
#include "messages/map_chunk.h"
#include "messages/obstacle_truth.h"
#include "messages/plan.h"
#include "messages/plan_timing.h"
#include "messages/track_set.h"
#include "messages/uav_state.h"
#include "runtime/batches.h"
#include "runtime/channels.h"

namespace tern::audit {
namespace {

/// Messages may come out of order or twice.
template <class T, class TimeOf>
void put_in_order(std::vector<T>& items, const TimeOf& time_of) {
  std::stable_sort(items.begin(), items.end(), [&](const T& a, const T& b) { return time_of(a) < time_of(b); });
  const auto same = [&](const T& a, const T& b) { return time_of(a) == time_of(b); };
  items.erase(std::unique(items.begin(), items.end(), same), items.end());
}

class Reading {
 public:
  explicit Reading(FlightRecord& record) : record_(record) {
    keep(channels::kUavState, record.states);
    keep(channels::kSetpoint, record.setpoints);
    keep(channels::kHorizonRequest, record.requests);
    keep(channels::kPlan, record.plans);
    keep(channels::kPlanTiming, record.timings);
    log_.on<ObstacleTruth>(channels::kObstacleTruth, [this](const ObstacleTruth& t, std::int64_t) { take(t); });
    log_.on<TrackSet>(channels::kPredictions, [this](const TrackSet& batch, std::int64_t) { take(batch); });
    log_.on<MapChunk>(channels::kSemanticMap, [this](const MapChunk& chunk, std::int64_t) { take(chunk); });
    log_.on<Goal>(channels::kGoal, [this](const Goal& goal, std::int64_t) {
      if (record_.goals.empty() || record_.goals.back().id != goal.id) record_.goals.push_back(goal);
    });
    log_.on<FlightResult>(channels::kFlightResult, [this](const FlightResult& result, std::int64_t) {
      const auto& known = record_.results;
      const bool repeated = !known.empty() && known.back().flight_time_s == result.flight_time_s;
      if (!repeated) record_.results.push_back(result);
    });
    log_.on<ConfigurationReport>(channels::kConfiguration,
                                 [this](const ConfigurationReport& report, std::int64_t) { take(report); });
  }

  Result<void> run() {
    auto contents = log_.read(record_.path);
    if (!contents) return tl::make_unexpected(contents.error());
    record_.contents = std::move(*contents);
    record_.incomplete_predictions = batches_.incomplete();
    put_in_order(record_.states, [](const UavState& s) { return s.at; });
    put_in_order(record_.setpoints, [](const UavState& s) { return s.at; });
    for (auto& [id, history] : record_.truth) {
      put_in_order(history.samples, [](const ObstacleHistory::Sample& s) { return s.at; });
    }
    return {};
  }

 private:
  template <class T>
  void keep(const char* channel, std::vector<T>& list) {
    log_.on<T>(channel, [&list](const T& message, std::int64_t) { list.push_back(message); });
  }

  void take(const ObstacleTruth& truth) {
    record_.truth_left_out = std::max<std::int64_t>(record_.truth_left_out, truth.left_out);
    for (const TrueObstacle& o : truth.obstacles) {
      ObstacleHistory& history = record_.truth[o.id];
      history.moves = history.moves || o.moves;
      history.samples.push_back({truth.at, o.position, o.velocity, o.half_extents});
    }
  }

  void take(const TrackSet& batch) {
    auto set = batches_.add(batch);
    if (!set) return;
    TrackSet whole = join_batches(std::move(*set));
    const MessageName name = whole.header.name;
    record_.predictions.emplace(name, std::move(whole));
  }

  void take(const MapChunk& chunk) {
    if (record_.maps.contains(chunk.version)) return;
    const auto complete = assembler_.add(chunk);
    if (!complete || !*complete) return;
    VoxelMap map = assembler_.take();
    record_.maps.emplace(map.version, std::move(map));
  }

  void take(const ConfigurationReport& report) {
    for (ConfigurationReport& known : record_.configurations) {
      if (known.process != report.process) continue;
      known = report;
      return;
    }
    record_.configurations.push_back(report);
  }

  FlightRecord& record_;
  FlightLog log_;
  BatchCollector<TrackSet> batches_;
  MapAssembler assembler_;
};

}  // namespace

std::int64_t FlightRecord::unread(const std::string& channel) const {
  const auto found = contents.channels.find(channel);
  if (found == contents.channels.end()) return 0;
  std::int64_t sum = found->second.lost;
  for (const std::int64_t n : found->second.refused) sum += n;
  return sum;
}

UTime FlightRecord::zero() const {
  if (!requests.empty()) return requests.front().header.utime;
  return states.empty() ? UTime{} : states.front().at;
}

UTime FlightRecord::end() const { return states.empty() ? zero() : states.back().at; }

Result<FlightRecord> read_flight(const std::string& path) {
  FlightRecord record;
  record.path = path;
  Reading reading(record);
  if (auto done = reading.run(); !done) return tl::make_unexpected(done.error());
  return record;
}

}  // namespace tern::audit
