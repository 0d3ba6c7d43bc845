// Where a mission stands: which goal is sent now, and which steps were reached.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/knobs.h"
#include "core/world/goal.h"
#include "core/world/speed_limit.h"
#include "core/world/vehicle.h"
#include "mission/mission.h"

namespace tern::mission {

/// The knobs of the flight. A mission's file has priority where it states a value.
struct ProgressConfig {
  double radius_m = 2.0;
  double stop_radius_m = 0.5;
  double landing_height_m = 1.0;

  template <typename V>
  void visit(V& v) {
    v("radius_m", radius_m, Range{0.1, 1000.0}, "a waypoint that is passed counts within this distance, m");
    v("stop_radius_m", stop_radius_m, Range{0.05, 100.0},
      "a vehicle at rest within this distance of a waypoint is there, m");
    v("landing_height_m", landing_height_m, Range{0.1, 100.0},
      "the last goal of a landing is this far above the place's altitude, m");
  }
};

enum class Stand : std::uint8_t { Waiting, Flying, Staying, Paused, Done, Failed };

/// Where an earlier process of the same flight stood.
struct Remembered {
  int step = 0;
  bool is_paused = false;      ///< by an order
  std::optional<Stand> ended;  ///< Done or Failed: nothing is flown again
  std::string text;            ///< Progress::text()
  std::vector<std::optional<UTime>> reached;
};

/// Flies the steps of a mission by goals. Pure: times are arguments and must not descend.
///
/// | stand   | entered when                                                           | goal                         |
/// |---------|------------------------------------------------------------------------|------------------------------|
/// | Waiting | at the start; until the vehicle follows                                | Hold                         |
/// | Flying  | the vehicle follows; a step is over; a detour is over                  | Go to the step's position    |
/// | Staying | the vehicle rests at a Stop, or is beside its track                    | the same                     |
/// | Paused  | a goal of another process with a larger id                             | none                         |
/// | Paused  | pause(), until go_on()                                                 | Hold                         |
/// | Done    | the last step is over                                                  | the last one                 |
/// | Failed  | a step takes longer than time_limit_s(), or its track is lost          | Hold                         |
///
/// - **Pass.** The next goal is sent kGoalLatency before the vehicle enters the radius, since it takes effect that much
///   later. The vehicle then need not stop. If it turns away before it was within the radius, it flies to the step
///   again, and the next goal is sent within the radius.
/// - **Paused.** A goal to hold or stop pauses the mission. A goal to go to is a detour: the mission goes on when the
///   vehicle rests there. So a goal at the vehicle's own position lets it go on at once.
/// - **Pilot.** Steps are judged and goals are made only while the vehicle follows. A new goal would take it away from
///   a pilot.
/// - **Restart.** The number of the step is part of a goal's id (step_of). The vehicle repeats its goal, so a new
///   process finds the step in it. A mission that had ended stays ended, and sends no goal.
class Progress {
 public:
  /// @param first  step to begin with, 0 … steps − 1
  Progress(Mission mission, const ProgressConfig& config, const Limits& limits);

  /// The vehicle's state. @param now  when it was received
  void receive(const UavState& state, UTime now);
  void set_following(bool following, UTime now);
  /// A goal on the bus that this process did not send.
  void receive(const Goal& goal, UTime now);
  /// The centre of the followed track (W, m) in kFollowAhead: the vehicle needs that long to come there.
  void receive_track(const Vec3& centre, UTime now);
  /// Begins.
  /// @param heard  the vehicle's newest goal: if it is one of this mission, the mission goes on from there
  /// @param remembered  where an earlier process of this flight stood, for goals whose id holds no step
  void start(const std::optional<Goal>& heard, const std::optional<Remembered>& remembered, UTime now);

  /// An operator's orders. Pausing holds the vehicle; going on flies to the present step. @return false if it is not
  /// flown
  bool pause(UTime now);
  bool go_on(UTime now);

  /// Returns the goal to be published now, if there is one: a new one at once, then at 1 Hz.
  std::optional<Goal> due(UTime now);
  /// The speed limit of the newest goal, to be published before it; nullopt: none.
  [[nodiscard]] const std::optional<SpeedLimit>& speed_limit() const { return speed_limit_; }
  [[nodiscard]] UTime next_wakeup() const;

  [[nodiscard]] Stand stand() const { return stand_; }
  [[nodiscard]] int step() const { return step_; }
  [[nodiscard]] const Mission& mission() const { return mission_; }
  /// When each step was reached; nullopt: not yet.
  [[nodiscard]] const std::vector<std::optional<UTime>>& reached() const { return reached_; }
  /// Steps that were flown to again, since the vehicle had turned away too early.
  [[nodiscard]] int repeats() const { return repeats_; }
  /// The track that the present step follows.
  [[nodiscard]] std::optional<std::int64_t> followed_track() const;
  /// In words, for people: "step 3 of 7, waypoint 4: 12.3 m away".
  [[nodiscard]] std::string text() const;

 private:
  void fly_to(int step, UTime now);
  void send(GoalMode mode, const Vec3& position, UTime now);
  void advance(UTime now);
  /// The step of a goal of this mission; nullopt for other goals.
  [[nodiscard]] std::optional<int> step_of_own(const Goal& goal) const;
  void judge(const UavState& state, UTime now);
  void judge_pass(const UavState& state, UTime now);
  void judge_stay(const UavState& state, UTime now);
  void judge_missed(const UavState& state, UTime now);
  void judge_time(const UavState& state, const Vec3& place, UTime now);
  void fail(std::string why, UTime now);
  [[nodiscard]] double radius_of(const Step& step) const;
  [[nodiscard]] bool rests_at(const UavState& state, const Vec3& place) const;

  Mission mission_;
  ProgressConfig config_;
  Limits limits_;
  Stand stand_ = Stand::Waiting;
  int step_ = 0;
  std::vector<std::optional<UTime>> reached_;
  std::optional<Goal> goal_;  ///< the newest one of this process
  std::optional<SpeedLimit> speed_limit_;
  UTime next_goal_;
  std::optional<Goal> other_;    ///< Paused: the goal of somebody else; nullopt: by pause()
  std::int64_t largest_id_ = 0;  ///< of all goals that were sent or received
  bool following_ = false;
  bool has_started_ = false;
  UTime step_since_, stay_since_, track_at_, track_sent_;
  std::optional<int> passing_;  ///< a Pass whose next goal was sent, but that was not reached yet
  bool passes_late_ = false;    ///< the step was missed: its next goal is sent within the radius
  std::optional<Vec3> track_;   ///< centre of the followed track, W
  Vec3 sent_from_ = Vec3::Zero();
  Vec3 position_ = Vec3::Zero();
  int repeats_ = 0;
  std::string why_failed_;
};

/// Stands for a step in the id of a goal that leads to none: a goal to hold.
inline constexpr int kNoStep = 4'095;

/// Returns the number of the step in a goal's id, 0 … kMaxSteps − 1; nullopt for other ids.
std::optional<int> step_of(std::int64_t goal_id);
/// Returns the id of a new goal: about the time in µs, with the step in its last bits, larger than `largest`.
std::int64_t goal_id(int step, UTime now, std::int64_t largest);

/// Returns the limits of velocity for a flight at a speed over the ground, m/s:
///
///     v_i = speed · max(|d_i|, 1/√2), i = x, y
///
/// d is the horizontal direction from `from` to `to`. So the speed is exact along d, and at most 1.23 times as
/// large in other directions. The vertical limit is the vehicle's.
Vec3 velocity_limits(double speed, const Vec3& from, const Vec3& to, const Limits& limits);

/// A step may take this long, s: as a flight may (flight_timeout_s), and 20 s more for detours around movers.
double time_limit_s(const Vec3& from, const Vec3& to, const Limits& limits);

/// Time from a goal to the first setpoint that leads there: at least the lead of a request, and an answer. With a
/// smaller value the vehicle brakes more at a pass; with a larger one it misses the radius.
inline constexpr Duration kGoalLatency{100'000};
/// A vehicle slower than this is at rest, m/s: above the noise of estimates.
inline constexpr double kSpeedAtRest = 0.3;
/// A followed track that was not received for this long is lost.
inline constexpr Duration kTrackLost{5'000'000};
/// A followed track's goal is sent again at this period, if it has moved by kTrackMoved.
inline constexpr Duration kFollowPeriod{200'000};
inline constexpr double kTrackMoved = 0.1;  ///< m
inline constexpr Duration kFollowAhead{500'000};
/// A vehicle this near to its place beside a track is there, m.
inline constexpr double kBeside = 5.0;

}  // namespace tern::mission
