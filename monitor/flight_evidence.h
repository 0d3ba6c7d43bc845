// The course of a flight, as far as its end is explained by it (flight_cause.h).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/wire/health.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/vehicle_status.h"

namespace tern {

/// The planner's answer to one request, or its absence.
struct AnswerNote {
  UTime at;  ///< of the answer, or when it was due
  PlanOutcome outcome = PlanOutcome::NoPlan;
  PlanReason reason = PlanReason::None;
  bool in_time = false;            ///< false: published after the deadline, or never
  double predictions_age_s = 0.0;  ///< of the newest PREDICTIONS at the request; infinite: none was received
};

/// The last words of a process while it was not ready, or of the vehicle while it flew by itself.
struct Complaint {
  UTime since, heard;
  std::string text;
};

/// How often predictions had an obstacle at a place.
struct Covered {
  std::int64_t sets = 0, covered = 0;  ///< all sets, and those with an obstacle there
  std::int64_t track = 0;              ///< the newest such track
  TrackKind kind = TrackKind::Static;  ///< of it
  std::int64_t last_set = 0;           ///< the number of the last set that was counted as covered
  void note(const Track& there, std::int64_t set);
};

/// Collects a flight's messages. Times are those in the messages, by the vehicle's clock; nothing depends on when a
/// message is received.
class FlightEvidence {
 public:
  /// @param start, goal  of the scenario, until GOAL says otherwise
  FlightEvidence(const Vec3& start, const Vec3& goal) : start_(start), goal_(goal), closest_m_((goal - start).norm()) {}

  void receive(const Heartbeat& heartbeat);
  void receive(const UavState& state);
  void receive(const VehicleStatus& status);
  void receive(const Goal& goal);
  void receive(const HorizonRequest& request);
  void receive(const Plan& plan);
  void receive(const PlanTiming& timing) { answer_ms_.push_back(timing.total_ms); }
  void receive(const TrackSet& predictions);
  void receive(const ObservationSet& observations);
  void receive(const ConfigurationReport& report);

  /// The first request after the goal to fly to; nullopt if the flight never began.
  [[nodiscard]] std::optional<UTime> begun() const { return begun_; }
  [[nodiscard]] UTime newest() const { return newest_; }  ///< newest time in any message
  [[nodiscard]] const std::optional<UavState>& state() const { return state_; }
  [[nodiscard]] const VehicleStatus& status() const { return status_; }
  [[nodiscard]] const std::optional<HorizonRequest>& last_request() const { return last_request_; }
  [[nodiscard]] const Vec3& start() const { return start_; }
  [[nodiscard]] const Vec3& goal() const { return goal_; }
  [[nodiscard]] const std::vector<AnswerNote>& answers() const { return answers_; }
  [[nodiscard]] const std::vector<double>& answer_ms() const { return answer_ms_; }
  /// Since when the vehicle has stood; nullopt if it moves.
  [[nodiscard]] std::optional<UTime> stood_since() const;
  /// The last time at which the vehicle had come nearer to its goal by kProgress.
  [[nodiscard]] UTime progress_at() const { return progress_at_; }
  /// The reason why the vehicle has ceased to follow; nullopt if it follows, or never did.
  [[nodiscard]] const std::optional<Complaint>& not_following() const { return not_following_; }
  /// The processes that are not ready, by name.
  [[nodiscard]] const std::map<std::string, Complaint>& not_ready() const { return not_ready_; }
  /// The processes that said that they are overloaded, by name.
  [[nodiscard]] const std::map<std::string, Complaint>& overloaded() const { return overloaded_; }
  /// Since when UAV_STATE has had one position and velocity, though by them the vehicle moves, or plans begin
  /// kStandRadius away from it. nullopt: it changes, or the vehicle may rest there.
  [[nodiscard]] std::optional<UTime> frozen_since() const;
  /// The process of the flight that was not heard for kProcessSilence at the end, and when it was heard last. Logger,
  /// monitor and viewer do not fly.
  [[nodiscard]] std::optional<std::pair<std::string, UTime>> silent_process() const;
  /// The body at the goal, in the predictions since the vehicle last came nearer to it; α does not count.
  [[nodiscard]] const Covered& goal_covered() const { return goal_covered_; }
  /// The body with its tube at the newest request's start, in the same predictions; α counts.
  [[nodiscard]] const Covered& start_covered() const { return start_covered_; }
  /// The words of tern-planner's newest HEARTBEAT about a goal that is blocked; may be empty.
  [[nodiscard]] const std::string& blocked_goal() const { return blocked_goal_; }
  /// How late detections were when they came, s; nullopt without any.
  [[nodiscard]] std::optional<double> sensor_late_s() const { return sensor_late_s_; }
  [[nodiscard]] double stale_after_s() const { return stale_after_s_; }

 private:
  void settle(UTime vehicle_time);
  void note_progress(UTime at);
  struct Open {
    UTime deadline;
    double predictions_age_s = 0.0;
  };

  Vec3 start_, goal_;
  std::optional<UTime> begun_;
  UTime newest_, progress_at_, predictions_made_;
  std::optional<UavState> state_;
  VehicleStatus status_;
  std::optional<HorizonRequest> last_request_;
  std::map<std::int64_t, Open> open_;  ///< requests without an answer, by id
  std::vector<AnswerNote> answers_;
  std::vector<double> answer_ms_;
  std::optional<UavState> anchor_;   ///< the vehicle has been within kStandRadius of it since
  std::optional<UTime> slow_since_;  ///< first time below kStandSpeed since then
  UTime same_since_;                 ///< state_ has had the same position and velocity since
  double closest_m_;
  bool is_held_ = false;  ///< told to hold, as an autopilot is until the flight begins
  bool has_followed_ = false;
  std::optional<Complaint> not_following_;
  std::map<std::string, Complaint> not_ready_, overloaded_;
  std::map<std::string, UTime> heard_;  ///< last HEARTBEAT by process
  std::string blocked_goal_;
  Covered goal_covered_, start_covered_;
  std::optional<double> sensor_late_s_;
  double stale_after_s_ = 0.3;
};

/// A vehicle stands if it was slower than kStandSpeed (m/s, as of the referee's stops), and has stayed within
/// kStandRadius (m) for kStandTime. A hovering vehicle may never be so slow: it stands after kHoverTime.
inline constexpr double kStandRadius = 0.5, kStandSpeed = 0.1;
inline constexpr Duration kStandTime{1'000'000}, kHoverTime{5'000'000};
inline constexpr double kProgress = 0.5;  ///< least way that counts as progress, m
/// Four HEARTBEATs may be lost.
inline constexpr Duration kProcessSilence{2'500'000};
}  // namespace tern
