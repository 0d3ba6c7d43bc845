#include "tools/audit/flight_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/scenario/obstacle_names.h"
#include "flight_log/track_sets.h"
#include "messages/codec.h"

namespace tern::audit {
namespace {

/// Sorts messages and drops repeated ones.
template <class T, class TimeOf>
void put_in_order(std::vector<T>& items, const TimeOf& time_of) {
  std::ranges::stable_sort(items, [&](const T& a, const T& b) { return time_of(a) < time_of(b); });
  const auto same = [&](const T& a, const T& b) { return time_of(a) == time_of(b); };
  items.erase(std::unique(items.begin(), items.end(), same), items.end());
}

/// The messages of one sender of vehicle, world or setpoints: one run of a simulator or an executor.
struct SenderMessages {
  std::vector<UavState> estimates, true_states, setpoints;
  std::vector<VehicleStatus> statuses;
  std::map<std::int64_t, ObstacleHistory> truth;
  std::map<std::int64_t, std::vector<DeclaredPiece>> declared;
  std::vector<FlightResult> results;
  std::int64_t truth_left_out = 0;
};

/// A declaration applies from when it was given until the next one.
void declare(const Track& track, UTime made_at, std::vector<DeclaredPiece>& pieces) {
  while (!pieces.empty() && pieces.back().curve.from >= made_at) pieces.pop_back();
  if (!pieces.empty()) pieces.back().curve.to = std::min(pieces.back().curve.to, made_at);
  const std::vector<Curve> curves = curves_of(track.motion);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (curves[k].to <= made_at) continue;
    pieces.push_back({curves[k].cut(std::max(curves[k].from, made_at), curves[k].to), track.alpha[k]});
  }
}

class Reading {
 public:
  explicit Reading(FlightRecord& record) : record_(record) {
    log_.on(channels::kHorizonRequest, [this](const HorizonRequest& request, std::int64_t) {
      record_.frames_before.emplace(request.header.name, record_.frames.size());
      record_.requests.push_back(request);
    });
    log_.on(channels::kObstacleSightings, [this](const SightingSet& frame, std::int64_t) {
      record_.frames.push_back(frame);
      record_.frames.back().sightings.clear();
    });
    keep(channels::kObstacleObservations, record.observations);
    log_.on(channels::kObstacleSightings, [this](const SightingSet& set, std::int64_t) { take(set); });
    keep(channels::kPlan, record.plans);
    keep(channels::kPlanTiming, record.timings);
    keep(channels::kPlanHeading, record.headings);
    collect(channels::kUavState, [](SenderMessages& messages, const UavState& s) { messages.estimates.push_back(s); });
    collect(channels::kVehicleTruth,
            [](SenderMessages& messages, const UavState& s) { messages.true_states.push_back(s); });
    collect(channels::kSetpoint, [](SenderMessages& messages, const UavState& s) { messages.setpoints.push_back(s); });
    collect(channels::kVehicleStatus,
            [](SenderMessages& messages, const VehicleStatus& s) { messages.statuses.push_back(s); });
    log_.on(channels::kOdometry, [this](const Odometry& odometry, std::int64_t) {
      const bool is_valid = odometry.state == EstimatorState::Tracking || odometry.state == EstimatorState::Blind;
      if (is_valid) record_.odometry.push_back(odometry);
    });
    collect(channels::kObstacleTruth, take_truth);
    collect(channels::kFlightResult, take_result);
    log_.on(channels::kDeclaredMotions, [this](const TrackSet& batch, std::int64_t) { declared(batch); });
    log_.on(channels::kPoseError, [this](const PoseError& error, std::int64_t) { predictions_.add(error); });
    log_.on(channels::kPredictions, [this](const TrackSet& batch, std::int64_t) { predicted(batch); });
    log_.on(channels::kSemanticMap, [this](const MapChunk& chunk, std::int64_t) { take(chunk); });
    log_.on(channels::kGoal, [this](const Goal& goal, std::int64_t) {
      record_.goal_names.insert(goal.header.name);
      if (record_.goals.empty() || record_.goals.back().id != goal.id) record_.goals.push_back(goal);
    });
    log_.on(channels::kHeartbeat, [this](const Heartbeat& heartbeat, std::int64_t) {
      record_.processes.insert(heartbeat.process);
      const bool is_logger = heartbeat.process == "tern-logger" && heartbeat.state == ProcessState::Failed;
      if (is_logger) record_.logger_trouble = heartbeat.waiting_for;
    });
    log_.on(channels::kConfiguration, [this](const ConfigurationReport& report, std::int64_t) { take(report); });
  }

  Result<void> run() {
    auto contents = log_.read(record_.path);
    if (!contents) return tl::make_unexpected(contents.error());
    record_.contents = std::move(*contents);
    record_.incomplete_predictions = predictions_.incomplete();
    choose_flight();
    put_in_order(record_.states, [](const UavState& s) { return s.at; });
    put_in_order(record_.estimates, [](const UavState& s) { return s.at; });
    put_in_order(record_.setpoints, [](const UavState& s) { return s.at; });
    put_in_order(record_.statuses, [](const VehicleStatus& s) { return s.at; });
    put_in_order(record_.odometry, [](const Odometry& o) { return o.at; });
    std::ranges::stable_sort(record_.observations, {}, &ObservationSet::at);
    std::ranges::stable_sort(record_.sightings, {}, &ObservationSet::at);
    for (auto& [id, history] : record_.truth) {
      put_in_order(history.samples, [](const ObstacleHistory::Sample& s) { return s.at; });
    }
    return {};
  }

 private:
  template <class T>
  void keep(const Channel<T>& channel, std::vector<T>& list) {
    log_.on(channel, [&list](const T& message, std::int64_t) { list.push_back(message); });
  }

  template <class T>
  void collect(const Channel<T>& channel, void (*put)(SenderMessages&, const std::type_identity_t<T>&)) {
    log_.on(channel, [this, put](const T& m, std::int64_t) { put(by_sender_[m.header.name.sender_epoch_us], m); });
  }

  static void take_truth(SenderMessages& messages, const ObstacleTruth& truth) {
    messages.truth_left_out = std::max<std::int64_t>(messages.truth_left_out, truth.left_out);
    for (const TrueObstacle& o : truth.obstacles) {
      ObstacleHistory& history = messages.truth[o.id];
      history.moves = history.moves || o.moves;
      history.samples.push_back({truth.at, o.position, o.velocity, o.half_extents});
    }
  }

  static void take_result(SenderMessages& messages, const FlightResult& result) {
    const bool repeated = !messages.results.empty() && messages.results.back().flight_time_s == result.flight_time_s;
    if (!repeated) messages.results.push_back(result);
  }

  void declared(const TrackSet& batch) {
    const auto set = declarations_.add(batch);
    if (!set) return;
    auto& by_id = by_sender_[set->header.name.sender_epoch_us].declared;
    for (const Track& track : set->tracks) {
      if (track.kind != TrackKind::Static) declare(track, set->made_at, by_id[track.id]);
    }
  }

  void predicted(const TrackSet& batch) {
    auto whole = predictions_.add(batch);
    if (!whole) return;
    const MessageName name = whole->header.name;
    record_.predictions.emplace(name, std::move(*whole));
  }

  void take(const SightingSet& frame) {
    ObservationSet& parts = record_.sightings.emplace_back();
    parts.at = frame.at;
    parts.sensor_id = frame.sensor_id;
    for (const Sighting& sighting : frame.sightings) {
      Detection part;
      part.position = 0.5 * (sighting.lower + sighting.upper);
      part.half_extents = 0.5 * (sighting.upper - sighting.lower);
      parts.detections.push_back(part);
    }
  }

  void take(const MapChunk& chunk) {
    if (record_.maps.contains(chunk.version)) return;
    const auto complete = assembler_.add(chunk);
    if (!complete || !*complete) return;
    VoxelMap map = assembler_.take();
    record_.maps.emplace(map.version, std::move(map));
  }

  void take(const ConfigurationReport& report) {
    record_.configuration_hashes.insert(report.hash);
    for (ConfigurationReport& known : record_.configurations) {
      if (known.process != report.process) continue;
      known = report;
      return;
    }
    record_.configurations.push_back(report);
  }

  /// Returns one kind of message of the flight's own world. Vehicle, executor and sensors may be processes of their
  /// own. Then it returns the messages of all senders outside of other flights.
  template <class T, class Merge>
  T of_flight(std::int64_t world, T SenderMessages::*kind, const Merge& merge) {
    T all;
    for (auto& [sender, messages] : by_sender_) {
      if (sender == world && !(messages.*kind).empty()) return std::move(messages.*kind);
    }
    for (auto& [sender, messages] : by_sender_) {
      if (!others_.contains(sender)) merge(all, messages.*kind);
    }
    return all;
  }

  /// Returns the time of a world's last OBSTACLE_TRUTH.
  static UTime last_truth(const SenderMessages& world) {
    UTime last{INT64_MIN};
    for (const auto& [id, history] : world.truth) last = std::max(last, history.samples.back().at);
    return last;
  }

  /// Returns the sender of the flight's world: the executor itself if it hosts one, otherwise the first world that
  /// lasted until the first request. A simulator publishes its world while it waits, and may end before the flight.
  [[nodiscard]] std::int64_t own_world() const {
    const auto has_truth = [](const auto& known) { return !known.second.truth.empty(); };
    if (!record_.requests.empty()) {
      const Header& asked = record_.requests.front().header;
      const auto own = by_sender_.find(asked.name.sender_epoch_us);
      if (own != by_sender_.end() && has_truth(*own)) return own->first;
      const auto lasted = std::ranges::find_if(
          by_sender_, [&](const auto& known) { return has_truth(known) && last_truth(known.second) >= asked.utime; });
      if (lasted != by_sender_.end()) return lasted->first;
    }
    const auto first = std::ranges::find_if(by_sender_, has_truth);
    if (first != by_sender_.end()) return first->first;
    return by_sender_.empty() ? 0 : by_sender_.begin()->first;
  }

  void choose_flight() {
    const std::int64_t epoch = own_world();
    name_others(epoch);
    const auto append = [](auto& all, auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    record_.states = of_flight(epoch, &SenderMessages::true_states, append);
    record_.estimates = of_flight(epoch, &SenderMessages::estimates, append);
    if (record_.states.empty()) record_.states = record_.estimates;
    record_.setpoints = of_flight(epoch, &SenderMessages::setpoints, append);
    record_.statuses = of_flight(epoch, &SenderMessages::statuses, append);
    record_.results = of_flight(epoch, &SenderMessages::results, append);
    record_.truth = of_flight(epoch, &SenderMessages::truth, [&](auto& all, auto& more) {
      for (auto& [id, history] : more) {
        all[id].moves = all[id].moves || history.moves;
        append(all[id].samples, history.samples);
      }
    });
    record_.declared = of_flight(epoch, &SenderMessages::declared, [&](auto& all, auto& more) {
      for (auto& [id, pieces] : more) append(all[id], pieces);
    });
    for (auto& [id, pieces] : record_.declared) {
      std::ranges::stable_sort(
          pieces, [](const DeclaredPiece& a, const DeclaredPiece& b) { return a.curve.from < b.curve.from; });
    }
    for (const auto& [sender, messages] : by_sender_) {
      if (!others_.contains(sender)) record_.truth_left_out = std::max(record_.truth_left_out, messages.truth_left_out);
    }
    forget_others();
  }

  /// Finds other worlds, and the executors that flew in them: those that started after this one ended.
  void name_others(std::int64_t world) {
    const auto own = by_sender_.find(world);
    if (own == by_sender_.end() || own->second.truth.empty()) return;
    std::map<std::int64_t, std::int64_t> requests;
    for (const HorizonRequest& r : record_.requests) ++requests[r.header.name.sender_epoch_us];
    const UTime last = last_truth(own->second);
    for (const auto& [sender, messages] : by_sender_) {
      if (sender == world || (messages.truth.empty() && (sender <= last.us || !requests.contains(sender)))) continue;
      others_.insert(sender);
      record_.other_flights.push_back(fmt::format("another flight: sender {} {}, {} requests: not audited", sender,
                                                  messages.truth.empty() ? "came after it" : "has a world of its own",
                                                  requests[sender]));
    }
  }

  /// Removes requests of other executors and their answers.
  void forget_others() {
    if (others_.empty()) return;
    // A timing names its request by id only, which both flights may have; but a planner sends one timing per plan.
    std::set<MessageName> foreign;
    for (const Plan& p : record_.plans) {
      if (others_.contains(p.inputs.request.sender_epoch_us)) foreign.insert(p.header.name);
    }
    std::erase_if(record_.timings, [&](const PlanTiming& t) { return foreign.contains(t.header.name); });
    std::erase_if(record_.plans, [&](const Plan& p) { return others_.contains(p.inputs.request.sender_epoch_us); });
    std::erase_if(record_.headings, [&](const PlanHeading& h) { return others_.contains(h.request.sender_epoch_us); });
    std::erase_if(record_.requests,
                  [&](const HorizonRequest& r) { return others_.contains(r.header.name.sender_epoch_us); });
  }

  FlightRecord& record_;
  FlightLog log_;
  std::map<std::int64_t, SenderMessages> by_sender_;  ///< by sender epoch
  std::set<std::int64_t> others_;                     ///< senders with a flight of their own
  RecordedSets declarations_, predictions_;
  MapAssembler assembler_;
};

}  // namespace

std::int64_t FlightRecord::unread(const std::string& channel) const {
  const auto found = contents.channels.find(channel);
  if (found == contents.channels.end()) return 0;
  return found->second.lost + found->second.before_first + found->second.refused_total();
}

std::string FlightRecord::name_of(std::int64_t obstacle) const {
  return "obstacle " + with_name(obstacle, obstacle_names);
}

const HorizonRequest* FlightRecord::request(const MessageName& name) const {
  const auto found = std::ranges::find_if(requests, [&](const HorizonRequest& r) { return r.header.name == name; });
  return found == requests.end() ? nullptr : &*found;
}

UTime FlightRecord::zero() const {
  if (!requests.empty()) {
    const auto goes = [](const Goal& goal) { return goal.mode == GoalMode::Go; };
    const auto go = std::ranges::find_if(goals, goes);
    const bool held_first = go != goals.end() && go != goals.begin();
    const auto begun = std::ranges::find_if(
        requests, [&](const HorizonRequest& r) { return !held_first || r.header.utime >= go->header.utime; });
    return (begun == requests.end() ? requests.begin() : begun)->header.utime;
  }
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
