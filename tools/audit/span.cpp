#include "tools/audit/span.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "messages/channels.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

/// The channels that no check can do without, if the log has them.
constexpr std::tuple kJudged{channels::kUavState,       channels::kVehicleTruth, channels::kSetpoint,
                             channels::kHorizonRequest, channels::kPlan,         channels::kPredictions,
                             channels::kObstacleTruth,  channels::kSemanticMap,  channels::kGoal,
                             channels::kConfiguration,  channels::kFlightResult};
constexpr double kSilence = kLogSilence.seconds();
/// A shorter hole of the motion is counted, but a busy machine has such ones: executors wait as long for UAV_STATE.
constexpr Duration kLongHole{300'000};
constexpr double kGoalRadius = 0.2;  ///< as the referee's, m
constexpr double kRestSpeed = 0.1;   ///< the same, m/s

/// Without a referee, the flight has ended if the vehicle is at rest, at its goal, or flown by somebody else.
bool ends_in_flight(const FlightRecord& record) {
  if (record.estimates.empty()) return false;
  const MotionSample& last = record.estimates.back().motion;
  const bool follows = record.statuses.empty() || record.statuses.back().following;
  const bool arrived = !record.goals.empty() && (record.goals.back().position - last.p).norm() < kGoalRadius;
  return follows && !arrived && last.v.norm() > kRestSpeed;
}

/// Finds the gaps of a flight that began.
class Gaps {
 public:
  Gaps(const FlightRecord& record, const LogSpan& span) : record_(record), span_(span) {}

  std::vector<std::string> find() {
    if (!record_.requests.empty() && record_.requests.front().id > 1) {
      add(fmt::format("the flight's beginning: the first request in the log is number {}",
                      record_.requests.front().id));
    }
    end();
    silences();
    states();
    refusals();
    damage();
    return std::move(gaps_);
  }

 private:
  void add(std::string gap) { gaps_.push_back(std::move(gap)); }
  [[nodiscard]] double flight_end_s() const { return span_.flight_s.value_or(span_.to_s); }

  void end() {
    if (!record_.results.empty()) return;
    if (span_.flight_s || record_.processes.contains("tern-simulator")) {
      add(fmt::format("the flight's end: the log ends at {:.2f} s without FLIGHT_RESULT", span_.to_s));
    } else if (ends_in_flight(record_)) {
      add(fmt::format("the flight's end: the log ends at {:.2f} s, while the vehicle flies", span_.to_s));
    }
  }

  void silences() {
    const auto& spans = record_.contents.spans;
    for (std::size_t k = 1; k < spans.size(); ++k) {
      const double from = record_.seconds(UTime{spans[k - 1].second}), to = record_.seconds(UTime{spans[k].first});
      if (to > 0.0 && from < flight_end_s()) add(fmt::format("all messages from {:.2f} to {:.2f} s", from, to));
    }
  }

  void states() {
    if (record_.states.empty()) return add("the vehicle's states");
    const Window window = judged_window(record_);
    const UTime first = record_.states.front().at, last = record_.states.back().at;
    const double to = record_.seconds(last);
    if (first > window.sure_from() + kLongHole) {
      add(fmt::format("the vehicle's states before {:.2f} s", record_.seconds(first)));
    }
    if (to < std::min(flight_end_s(), span_.to_s) - kSilence || last + kLongHole < window.to) {
      add(fmt::format("the vehicle's states from {:.2f} s on", to));
    }
    holes(window);
  }

  void holes(const Window& window) {
    Duration sum;
    int count = 0;
    for (const MotionSpan& span : vehicle_motion(record_).spans) {
      const UTime from = std::max(span.curve.from, window.sure_from()), to = std::min(span.curve.to, window.to);
      if (!span.hole || to - from <= kLongHole) continue;
      sum = sum + (to - from);
      ++count;
    }
    if (count > 0) {
      add(fmt::format("the vehicle's motion for {:.2f} s: {} times no state for more than {:g} s", sum.seconds(), count,
                      kLongHole.seconds()));
    }
  }

  void refusals() {
    const auto look_at = [&](const auto& judged) {
      const auto found = record_.contents.channels.find(judged.name);
      if (found == record_.contents.channels.end()) return;
      const LogChannel& channel = found->second;
      const std::int64_t refused = channel.refused_total();
      if (refused == 0 || refused + channel.repeated < channel.messages) return;
      add(fmt::format("all {} messages of {}: damaged, or of another version", refused, judged.name));
    };
    for_each_channel(look_at, kJudged);
  }

  void damage() {
    const LogContents& log = record_.contents;
    for (const std::string& part : log.missing_parts) add("the log's part " + part);
    const bool in_flight = std::ranges::any_of(log.damaged, [&](const auto& place) {
      return place.second > record_.zero().us && record_.seconds(UTime{place.first}) < flight_end_s();
    });
    if (log.damage.missing > 0 && log.damage.places > 0) {
      add(fmt::format("{} messages, as the event numbers show; the log is damaged in {} places", log.damage.missing,
                      log.damage.places));
    } else if (log.damage.missing > 0) {
      add(fmt::format("{} messages which tern-logger could not write, as the event numbers show", log.damage.missing));
    } else if (in_flight) {
      add(fmt::format("what stood in {} damaged bytes of the log", log.damage.bytes));
    } else if (!record_.logger_trouble.empty()) {
      add("tern-logger: " + record_.logger_trouble);
    }
  }

  const FlightRecord& record_;
  const LogSpan& span_;
  std::vector<std::string> gaps_;
};

}  // namespace

LogSpan span_of(const FlightRecord& record) {
  LogSpan span;
  span.from_s = record.seconds(UTime{record.contents.first_us});
  span.to_s = record.seconds(UTime{record.contents.last_us});
  if (!record.results.empty()) {
    span.flight_s = record.results.back().flight_time_s;
  } else {
    span.flight_s = record.summary_flight_s;
  }
  const bool flew = !record.results.empty() && record.results.back().flight_time_s > 0.0;
  span.began = !record.requests.empty() || !record.plans.empty() || flew;
  if (span.began) span.gaps = Gaps(record, span).find();
  return span;
}

std::string to_text(const LogSpan& span) {
  return fmt::format("it reaches from {:.2f} to {:.2f} s{}", span.from_s, span.to_s,
                     span.flight_s ? fmt::format(" of a flight of {:.2f} s", *span.flight_s) : "");
}

}  // namespace tern::audit
