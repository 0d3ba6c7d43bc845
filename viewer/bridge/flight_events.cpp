#include "viewer/bridge/flight_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/names.h"
#include "viewer/bridge/json_writer.h"

namespace tern {
namespace {

constexpr std::size_t kMaxEvents = 4'000;
constexpr std::size_t kMaxProcessNames = 64;
constexpr std::size_t kPasses = 5;
constexpr double kRise = 0.1;                         ///< m
constexpr double kFarPass = 2.0;                      ///< m; a larger clearance is no pass
constexpr double kRestSpeed = 0.05, kFlySpeed = 0.5;  ///< m/s

}  // namespace

void FlightEvents::add(UTime at, const char* kind, std::string text) {
  if (events_.size() >= kMaxEvents) {
    ++left_out_;
  } else {
    events_.push_back({at, kind, std::move(text)});
  }
}

void FlightEvents::receive(const UavState& message) {
  const double speed = message.motion.v.norm();
  if (flies_ && speed < kRestSpeed) {
    const Vec3& p = message.motion.p;
    add(message.at, "stop", fmt::format("at rest at {:.1f}, {:.1f}, {:.1f}", p.x(), p.y(), p.z()));
    flies_ = false;
  }
  flies_ = flies_ || speed > kFlySpeed;
}

void FlightEvents::receive(const Plan& message) {
  if (outcome_ == message.outcome) return;
  const std::string before = outcome_ ? fmt::format("{} → ", to_string(*outcome_)) : "first answer: ";
  const std::string why = message.reason == PlanReason::None ? "" : fmt::format(" ({})", to_string(message.reason));
  add(message.header.utime, message.outcome == PlanOutcome::Evade ? "evasion" : "outcome",
      before + to_string(message.outcome) + why);
  outcome_ = message.outcome;
}

void FlightEvents::receive(const PlanTiming& message, double taken_ms, double allowed_ms) {
  const bool is_late = allowed_ms > 0.0 && taken_ms > allowed_ms;
  if (!is_late && !message.from_watchdog) return;
  add(message.header.utime, "late",
      fmt::format("answer {}: {:.1f} of {:.0f} ms{}", message.request_id, taken_ms, allowed_ms,
                  message.from_watchdog ? ", by the watchdog" : ""));
}

void FlightEvents::receive(const Goal& message) {
  if (message.id <= goal_id_) return;
  goal_id_ = message.id;
  const Vec3& p = message.position;
  add(message.header.utime, "goal",
      message.mode == GoalMode::Go ? fmt::format("goal {}: {:.1f}, {:.1f}, {:.1f}", message.id, p.x(), p.y(), p.z())
                                   : fmt::format("goal {}: {}", message.id, to_string(message.mode)));
}

void FlightEvents::receive(const FlightResult& message) {
  if (std::exchange(has_result_, true)) return;
  add(message.header.utime, "result",
      message.detail.empty() ? to_string(message.outcome)
                             : fmt::format("{}: {}", to_string(message.outcome), message.detail));
}

void FlightEvents::receive(const Heartbeat& message) {
  const std::int64_t epoch = message.header.name.sender_epoch_us;
  if (!epochs_.contains(message.process) && epochs_.size() >= kMaxProcessNames) return;
  const auto [known, is_new] = epochs_.emplace(message.process, epoch);
  if (is_new || epoch <= known->second) return;
  known->second = epoch;
  add(message.header.utime, "restart", message.process + " restarted");
}

void FlightEvents::receive_clearance(UTime at, std::optional<double> obstacles_m, std::optional<double> map_m) {
  if (obstacles_m) obstacles_.receive(at, *obstacles_m);
  if (map_m) map_.receive(at, *map_m);
}

void FlightEvents::Passes::receive(UTime at, double metres) {
  high_ = std::max(high_, metres);
  const bool approaches = low_ || metres < high_ - kRise;
  if (approaches && (!low_ || metres < low_->metres)) low_ = {at, metres};
  if (!low_ || metres < low_->metres + kRise) return;
  if (low_->metres < kFarPass) nearest_.push_back(*low_);
  std::sort(nearest_.begin(), nearest_.end(), [](const Pass& a, const Pass& b) { return a.metres < b.metres; });
  if (nearest_.size() > kPasses) nearest_.resize(kPasses);
  low_.reset();
  high_ = metres;
}

void FlightEvents::Passes::write(const char* what, std::vector<FlightEvent>& events) const {
  std::vector<Pass> all = nearest_;
  if (low_ && low_->metres < kFarPass) all.push_back(*low_);
  std::sort(all.begin(), all.end(), [](const Pass& a, const Pass& b) { return a.metres < b.metres; });
  if (all.size() > kPasses) all.resize(kPasses);
  for (std::size_t k = 0; k < all.size(); ++k) {
    events.push_back(
        {all[k].at, "clearance",
         fmt::format("{:.3f} m to {}{}", all[k].metres, what, k == 0 ? ", the least of the flight so far" : "")});
  }
}

std::vector<FlightEvent> FlightEvents::events() const {
  std::vector<FlightEvent> all = events_;
  obstacles_.write("an obstacle", all);
  map_.write("the map", all);
  std::stable_sort(all.begin(), all.end(), [](const FlightEvent& a, const FlightEvent& b) { return a.at < b.at; });
  return all;
}

std::string FlightEvents::json(UTime zero) const {
  JsonWriter json;
  json.begin_object().key("left_out").integer(left_out_).key("events").begin_list();
  for (const FlightEvent& event : events()) {
    json.begin_object().key("t").number((event.at - zero).seconds()).key("kind").text(event.kind);
    json.key("text").text(event.text).end_object();
  }
  return json.end_list().end_object().take();
}

}  // namespace tern
