#include "monitor/flight_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/percentiles.h"
#include "core/world/body.h"
#include "core/world/names.h"
#include "core/world/stated_bound.h"

namespace tern {
namespace {

constexpr const char* kSimulator = "tern-simulator";
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Without progress for this share of the flight, the time was not too short.
constexpr double kShareWithoutProgress = 0.3;
/// A vehicle that ceased to follow so shortly before the end was not held by that: the verdict itself ends the
/// following.
constexpr Duration kShortlyBefore{500'000};
/// A vehicle farther from its goal, by its own state, is not at it, m.
constexpr double kAtGoal = 0.2;
/// The answers before a contact that are told.
constexpr Duration kBeforeContact{1'000'000};

/// Kinds of answers that hold a vehicle, by what would help.
enum Kind { Stale, Blocked, Unplanned, Slow, Arrived, Other, Kinds };

Kind kind_of(const AnswerNote& answer) {
  if (!answer.in_time || answer.reason == PlanReason::OutOfTime) return Slow;
  switch (answer.reason) {
    case PlanReason::StaleWorld: return Stale;
    case PlanReason::GoalBlocked: return Blocked;
    case PlanReason::Infeasible:
    case PlanReason::StartInCollision:
    case PlanReason::SolverFailure: return Unplanned;
    case PlanReason::AtGoal: return Arrived;
    default: return Other;
  }
}

std::string place(const Vec3& p) {
  const Vec3 r = (p * 100.0).array().round() / 100.0 + 0.0;  // never -0.00
  return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", r.x(), r.y(), r.z());
}

class Explainer {
 public:
  Explainer(const FlightEvidence& evidence, const FlightEnd& end) : evidence_(evidence), end_(end) {
    const auto stood = evidence.stood_since();
    from_ = std::max(stood.value_or(evidence.progress_at()), evidence.begun().value_or(UTime{}));
    for (const AnswerNote& answer : evidence.answers()) {
      if (answer.at < from_) continue;
      kinds_[kind_of(answer)].push_back(&answer);
      ++answers_;
    }
    held_ = fmt::format("{} since {:.1f} s, {:.2f} m from the goal", stood ? "stood" : "came no nearer", seconds(from_),
                        left_m());
  }

  Explanation timeout() const {
    if (end_.detail.starts_with(kReachedAsBelieved)) {
      return {Cause::EstimateOff, end_.detail + "; texture in view of the goal, or a POSITION_FIX, would help"};
    }
    // The sender of the verdict lives; a slow machine may have delayed its HEARTBEAT.
    if (const auto silent = evidence_.silent_process(); silent && !(end_.result && silent->first == kSimulator)) {
      return {Cause::ProcessSilent,
              fmt::format("{}: {} was silent from {:.1f} s on, so it died or was cut off; {}.log says why", held_,
                          silent->first, seconds(silent->second), silent->first)};
    }
    const auto& complaint = evidence_.not_following();
    if (complaint && evidence_.newest() - complaint->since > kShortlyBefore) return not_following(*complaint);
    const auto executor = evidence_.not_ready().find("tern-executor");
    if (executor != evidence_.not_ready().end()) return not_ready(executor->second);
    if (const auto since = evidence_.frozen_since()) {
      return {Cause::StateRefused, fmt::format("{}: UAV_STATE has had one position and velocity since {:.1f} s, though "
                                               "the vehicle was to move; mend what sends it",
                                               held_, seconds(*since))};
    }
    if (is_on_its_way()) return time_too_short();
    return by_answers();
  }

  Explanation contact() const {
    const std::string& what = end_.detail;
    const FlightResult none;
    const FlightResult& result = end_.result ? *end_.result : none;
    if (what.starts_with("the start lies in")) {
      return {Cause::Contact, what + ": move uav.start, or the obstacle"};
    }
    const double speed = evidence_.state() ? evidence_.state()->motion.v.norm() : kNaN;
    if (result.contacts_at_rest > 0) {
      return {Cause::Contact,
              fmt::format("{}, at rest{}: it did not get out of the way; {}", what, stood_for(), answers_before())};
    }
    return {Cause::Contact, fmt::format("{}, flying at {:.1f} m/s; {}", what, speed, answers_before())};
  }

  Explanation failure() const {
    return {Cause::Failure, fmt::format("failed at {:.1f} s, {:.2f} m from the goal: {}", seconds(evidence_.newest()),
                                        left_m(), end_.detail)};
  }

  Explanation never_began() const {
    std::string waiting;
    for (const auto& [process, complaint] : evidence_.not_ready()) {
      waiting += fmt::format("{}{} ({})", waiting.empty() ? "" : ", ", process, complaint.text);
    }
    std::string why = end_.outcome == FlightOutcome::Failed && !end_.detail.empty() ? end_.detail : waiting;
    if (why.find("newer inputs") != std::string::npos)
      why += "; a faster sensor (latency_s) or a larger planner.stale_after_s would help";
    if (why.find("obstacle observations") != std::string::npos)
      why += "; a detector or a sensor of the scenario (simulator.sensor.mode) must send them";
    return {Cause::NeverBegan,
            "the flight never began: " + (why.empty() ? "no plan was requested" : why) + overload_text()};
  }

 private:
  [[nodiscard]] double seconds(UTime t) const { return (t - evidence_.begun().value_or(t)).seconds(); }
  [[nodiscard]] double left_m() const {
    return evidence_.state() ? (evidence_.goal() - evidence_.state()->motion.p).norm() : kNaN;
  }
  [[nodiscard]] std::size_t of(Kind kind) const { return kinds_[kind].size(); }

  [[nodiscard]] bool is_on_its_way() const {
    if (evidence_.stood_since() || !evidence_.state()) return false;
    const double flown_s = seconds(evidence_.newest()),
                 idle_s = (evidence_.newest() - evidence_.progress_at()).seconds();
    return idle_s < kShareWithoutProgress * flown_s;
  }

  [[nodiscard]] Explanation time_too_short() const {
    const double flown_s = seconds(evidence_.newest());
    const double gained_m = (evidence_.goal() - evidence_.start()).norm() - left_m();
    const double speed = gained_m / std::max(flown_s, 1e-3);
    std::string text = fmt::format("was on its way, {:.1f} m from the goal", left_m());
    if (speed > 0.0) {
      text += fmt::format(" at {:.1f} m/s on average: about {:.0f} s more would do (timeout_s)", speed,
                          std::ceil(left_m() / speed));
    }
    std::size_t slow = 0;
    for (const AnswerNote& answer : evidence_.answers()) slow += kind_of(answer) == Slow ? 1U : 0U;
    if (slow * 4 > evidence_.answers().size()) text += "; " + slow_text();
    return {Cause::TimeTooShort, text};
  }

  [[nodiscard]] Explanation not_following(const Complaint& complaint) const {
    constexpr std::string_view kStoodBack = "stood back: ";
    const bool is_lost = evidence_.status().estimator == EstimatorHealth::Lost ||
                         complaint.text.find("no position") != std::string::npos;
    const double at = seconds(complaint.since);
    if (is_lost) {
      return {Cause::EstimateLost, fmt::format("lost its position at {:.1f} s, {:.2f} m from the goal: {}; the flight "
                                               "goes on when the estimator has one again",
                                               at, left_m(), complaint.text)};
    }
    if (complaint.text.starts_with(kStoodBack)) {
      return {Cause::NotFollowing,
              fmt::format("stood back at {:.1f} s, {:.2f} m from the goal: {}; a new GOAL orders it to fly on", at,
                          left_m(), complaint.text.substr(kStoodBack.size()))};
    }
    return {Cause::NotFollowing,
            fmt::format("did not follow its setpoints from {:.1f} s on, {:.2f} m from the goal: {}", at, left_m(),
                        complaint.text)};
  }

  /// tern-executor says why it asks for no plans.
  [[nodiscard]] Explanation not_ready(const Complaint& executor) const {
    const std::string text =
        fmt::format("{}: tern-executor waited from {:.1f} s on: {}", held_, seconds(executor.since), executor.text);
    if (executor.text.starts_with("the live map")) {
      return {Cause::StaleWorld, text + "; scans must come again"};
    }
    const bool is_of_input =
        executor.text.starts_with("UAV_STATE is") || executor.text.starts_with("VEHICLE_STATUS is");
    if (!is_of_input) return {Cause::NotFollowing, text};
    return {Cause::StateRefused, text + "; what sends UAV_STATE and VEHICLE_STATUS must send sound ones in time"};
  }

  [[nodiscard]] Explanation by_answers() const {
    const auto most = std::max_element(kinds_.begin(), kinds_.begin() + Other,
                                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const auto kind = static_cast<Kind>(most - kinds_.begin());
    if (most->empty() || most->size() * 4 < answers_) return no_progress();
    switch (kind) {
      case Stale: return {Cause::StaleWorld, stale_text()};
      case Blocked: return {Cause::GoalBlocked, held_ + ": " + blocked_text()};
      case Unplanned: return {Cause::NoPlan, unplanned_text()};
      case Slow: return {Cause::TooSlow, held_ + ": " + slow_text()};
      case Arrived:
        if (left_m() > kAtGoal) {
          return {
              Cause::NotFollowing,
              fmt::format("{}: its setpoints rest at the goal, and it does not: wind or weak gains keep it off them",
                          held_)};
        }
        return {Cause::EstimateOff, fmt::format("rests at its goal by its own estimate, but not by the truth ({}): the "
                                                "estimate is off; mend the position source",
                                                end_.detail)};
      default: return no_progress();
    }
  }

  [[nodiscard]] std::string stale_text() const {
    std::string text = fmt::format("{}: {} answers *stale world*", held_, of(Stale));
    const double age = (*std::max_element(kinds_[Stale].begin(), kinds_[Stale].end(), [](const auto* a, const auto* b) {
                         return a->predictions_age_s < b->predictions_age_s;
                       }))->predictions_age_s;
    const double limit = evidence_.stale_after_s();
    if (std::isinf(age)) {
      const std::string overload = overload_text();
      return text + ": no PREDICTIONS came" +
             (overload.empty() ? "; does tern-predictor run, and does it get detections?" : overload);
    }
    if (age <= limit) return text + ": map or goal were missing; tern-planner's HEARTBEAT says which";
    text += fmt::format(", predictions up to {:.2f} s old", age);
    const auto late = evidence_.sensor_late_s();
    if (late && *late > 0.5 * limit) {
      return text + fmt::format(
                        ", sensor {:.2f} s late, limit {:g}: a faster sensor or a larger "
                        "planner.stale_after_s would help",
                        *late, limit);
    }
    if (const std::string overload = overload_text(); !overload.empty()) {
      return text + fmt::format(", limit {:g}", limit) + overload;
    }
    return text + fmt::format(", limit {:g}: detections or tern-predictor ceased, or the machine was too slow{}", limit,
                              slower_pace());
  }

  /// The words of overloaded processes since the vehicle was held; "" if there are none.
  [[nodiscard]] std::string overload_text() const {
    std::string text;
    for (const auto& [process, complaint] : evidence_.overloaded()) {
      if (complaint.heard >= from_) text += fmt::format("; {}: {}", process, complaint.text);
    }
    return text;
  }

  /// The request tells body, tube and box of the last answers; the planner's own words tell of obstacles.
  [[nodiscard]] std::string blocked_text() const {
    const auto& request = evidence_.last_request();
    const Vec3& goal = evidence_.goal();
    if (request && !places_within(request->flight_box, body_box(request->body)).contains(goal)) {
      return fmt::format(
          "the goal {} is not inside the flight box less the body: move the goal, or widen "
          "uav.flight_box",
          place(goal));
    }
    if (request && !places_within(request->flight_box, body_box(grown(request->body, request->tube))).contains(goal)) {
      return fmt::format(
          "the goal {} is inside the box, but not inside the box less a tube of {:.1f} m: widen "
          "uav.flight_box, move the goal, or fly a vehicle that tracks better",
          place(goal), request->tube.maxCoeff());
    }
    const std::string& by = evidence_.blocked_goal();
    const double tube = request ? request->tube.maxCoeff() : 0.0;
    return (by.empty() ? "map and obstacles leave no way to its goal" : by) +
           (tube > 0.0 ? fmt::format(", for the body and a tube of {:.1f} m", tube) : "") + "; fly.sh --check draws it";
  }

  [[nodiscard]] std::string unplanned_text() const {
    std::array<std::size_t, kPlanReasons> reasons{};
    for (const AnswerNote* answer : kinds_[Unplanned]) ++reasons[static_cast<std::size_t>(answer->reason)];
    const auto most = std::max_element(reasons.begin(), reasons.end());
    const auto reason = static_cast<PlanReason>(most - reasons.begin());
    const double tube = evidence_.last_request() ? evidence_.last_request()->tube.maxCoeff() : 0.0;
    const std::string body = tube > 0.0 ? fmt::format("the body with its tube of {:.1f} m", tube) : "the body";
    std::string text = fmt::format("{}: {} answers *{}*: ", held_, *most, to_string(reason));
    if (const Covered& there = evidence_.start_covered(); reason == PlanReason::StartInCollision && is_mostly(there)) {
      return text + fmt::format(
                        "{}, with its error bound, covers {}; a place farther away or a better prediction would "
                        "help",
                        name_of(there), body);
    }
    if (reason == PlanReason::StartInCollision) {
      return text + fmt::format(
                        "the map, or an obstacle that came and went, covers {}; with planner.unknown: obstacle "
                        "unknown voxels do so as well; {}a place farther away would help",
                        body, tube > 0.0 ? "a smaller executor.tube_m, " : "");
    }
    return text +
           fmt::format(
               "no certified way for {} past the obstacles; more room, a smaller tube or body, or later "
               "obstacles would help, and tern-replay plans an answer again",
               body) +
           overload_text();
  }

  [[nodiscard]] std::string slow_text() const {
    std::string text =
        fmt::format("the machine was too slow: {} of {} answers late or without time for a plan", of(Slow), answers_);
    const auto& request = evidence_.last_request();
    if (request && !evidence_.answer_ms().empty()) {
      text += fmt::format(" (p50 {:.0f} ms, allowed {:.0f})", percentiles(evidence_.answer_ms()).p50,
                          (request->deadline - request->header.utime).seconds() * 1e3 / end_.pace.value_or(1.0));
    }
    return text + slower_pace();
  }

  [[nodiscard]] std::string slower_pace() const {
    return end_.pace ? fmt::format(": --pace {:g}", std::max(0.5 * *end_.pace, 0.01)) : "";
  }

  static bool is_mostly(const Covered& place) { return 2 * place.covered > place.sets; }
  static std::string name_of(const Covered& place) {
    return fmt::format("{} obstacle (track {})", place.kind == TrackKind::Estimated ? "a detected" : "a declared",
                       place.track);
  }

  [[nodiscard]] Explanation no_progress() const {
    if (const Covered& there = evidence_.goal_covered(); is_mostly(there)) {
      return {Cause::GoalBlocked, fmt::format("{}: {} was at the goal in {} of {} predictions: move the goal, or wait "
                                              "until it has gone",
                                              held_, name_of(there), there.covered, there.sets)};
    }
    const auto kept = std::ranges::count_if(kinds_[Other], [](const AnswerNote* answer) {
      return answer->outcome != PlanOutcome::Optimized && answer->outcome != PlanOutcome::SearchOnly;
    });
    if (2 * kept > std::ssize(kinds_[Other])) {
      return {
          Cause::NoProgress,
          fmt::format("{}: {} of {} answers stayed or evaded, as no plan made more progress at its confidence; among "
                      "movers more room, a better sensor or a longer timeout_s would help",
                      held_, kept, answers_)};
    }
    return {Cause::NoProgress,
            fmt::format("{}, though {} of {} answers gave no reason against flying: the executor refused them, movers "
                        "kept it evading, or the vehicle does not obey; tern-executor.log says which",
                        held_, of(Other), answers_)};
  }

  [[nodiscard]] std::string stood_for() const {
    const auto since = evidence_.stood_since();
    return since ? fmt::format(" since {:.1f} s", seconds(*since)) : "";
  }

  [[nodiscard]] std::string answers_before() const {
    std::array<std::size_t, kPlanReasons> reasons{};
    std::size_t late = 0, all = 0;
    for (const AnswerNote& answer : evidence_.answers()) {
      if (answer.at < evidence_.newest() - kBeforeContact) continue;
      ++all;
      if (!answer.in_time) ++late;
      ++reasons[static_cast<std::size_t>(answer.reason)];
    }
    if (all == 0) return "no plan was answered in the last second";
    if (2 * late > all) return fmt::format("{} of its last {} answers were late{}", late, all, slower_pace());
    const auto most = std::max_element(reasons.begin() + 1, reasons.end());
    if (2 * *most > all) {
      return fmt::format("{} of its last {} answers were *{}*", *most, all,
                         to_string(static_cast<PlanReason>(most - reasons.begin())));
    }
    return "its last plans were certified, so a prediction or the tracking failed: tern-audit says which";
  }

  const FlightEvidence& evidence_;
  const FlightEnd& end_;
  UTime from_;  ///< since when the vehicle was held
  std::string held_;
  std::array<std::vector<const AnswerNote*>, Kinds> kinds_;
  std::size_t answers_ = 0;
};

}  // namespace

const char* to_string(Cause cause) {
  constexpr std::array<const char*, kCauses> kWords{"none",           "never began",   "failure",       "contact",
                                                    "process silent", "not following", "estimate lost", "state refused",
                                                    "stale world",    "goal blocked",  "no plan",       "too slow",
                                                    "estimate off",   "no progress",   "time too short"};
  return kWords.at(static_cast<std::size_t>(cause));
}

Explanation explain(const FlightEvidence& evidence, const FlightEnd& end) {
  if (end.outcome == FlightOutcome::Reached) return {};
  const Explainer explainer(evidence, end);
  if (end.outcome == FlightOutcome::Collision) return explainer.contact();
  if (!evidence.begun()) return explainer.never_began();
  if (end.outcome == FlightOutcome::Failed) return explainer.failure();
  return explainer.timeout();
}

}  // namespace tern
