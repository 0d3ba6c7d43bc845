// Requests plans, adopts the answers that can be flown, and holds the committed trajectory.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "core/base/knobs.h"
#include "core/scenario/scenario.h"
#include "core/world/goal.h"
#include "executor/adoption.h"
#include "executor/committed_trajectory.h"
#include "executor/tube.h"
#include "executor/yaw_follower.h"

namespace tern {

/// The section `executor`.
struct ExecutorConfig {
  double rate_hz = 20.0;
  Duration lead{75'000};       ///< > kDeadlineLead, ≤ 5 s
  double tube_m = 0.0;         ///< [0, kMaxTube]
  double start_reach_m = 5.0;  ///< (0, 1e5]
  YawFollowerConfig heading = {};

  template <typename V>
  void visit(V& v) {
    v("rate_hz", rate_hz, Range{1e-3, 100.0}, "largest number of requests per second");
    v("lead_s", lead, Range{0.01, 2.0},
      "time from a request to the start of its plan, s; the planner has 5 ms less than this");
    v("tube_m", tube_m, Range{0.0, kMaxTube},
      "smallest tube of a request, m per axis: how far the vehicle may be from its setpoints; a larger measured tube "
      "replaces it. Where a vehicle at rest starts in collision, it is halved, at most five times");
    v("start_reach_m", start_reach_m, Range{0.1, 1e5},
      "largest distance of the vehicle from `uav.start` when it first follows, m. At a larger one it is refused, "
      "because a frame or a unit must be wrong");
    v("heading", heading);
  }
};

/// Counts requests and plans. At any time requests = answered_in_time + unanswered + (0 or 1 outstanding).
struct ExecutorCounters {
  std::int64_t requests = 0;
  std::int64_t answered_in_time = 0;                  ///< with any verdict
  std::int64_t unanswered = 0;                        ///< closed by their deadline or by rejoin()
  std::array<std::int64_t, kVerdicts> verdicts = {};  ///< all plans by Verdict, also late, repeated and unknown ones
  std::array<std::int64_t, kBreaches> breaches = {};  ///< the unflyable plans by Breach

  [[nodiscard]] std::int64_t of(Verdict verdict) const { return verdicts[idx(verdict)]; }
  [[nodiscard]] std::int64_t of(Breach breach) const { return breaches[idx(breach)]; }
  [[nodiscard]] std::int64_t late() const { return of(Verdict::Late) + of(Verdict::TooLate); }
  [[nodiscard]] std::int64_t answered_twice() const { return of(Verdict::AnsweredTwice); }
  [[nodiscard]] std::int64_t refused() const;
};

/// Holds the committed trajectory, makes requests and adopts plans. Pure: times are arguments and must not descend.
///
/// 1. At most one request is outstanding. The next one follows its answer or its deadline, at no more than rate_hz.
/// 2. An answer is in time if now ≤ deadline. After the deadline the request is closed, and its answer is refused.
/// 3. No requests are made before the time of begin(), after pause(), without a goal mode, or in mode Stop. Neither are
///    they while the committed trajectory is faster than the speed limit.
/// 4. For a stationary vehicle requests continue, also at the goal: it must be able to evade.
class Executor {
 public:
  /// Commits to rest at uav.start from `now` on. @throws std::invalid_argument if config is out of its ranges.
  Executor(const UavSpec& uav, UTime now, const ExecutorConfig& config = {});
  /// Commits to braking_trajectory() from the measured state. @throws std::invalid_argument as above.
  Executor(const UavSpec& uav, const UavState& measured, const ExecutorConfig& config = {});

  /// The vehicle follows: requests are made from `go` on.
  void begin(UTime go) { requests_from_ = go; }
  /// The vehicle no longer follows: no more requests. The committed trajectory stays.
  void pause() { requests_from_.reset(); }
  /// Sets the tube of the next requests (HorizonRequest::tube), and the share of the vehicle's limits that they
  /// contain.
  /// @pre 0 < share ≤ 1
  void set_tube(const Vec3& tube, double share = 1.0);
  [[nodiscard]] const Vec3& tube() const { return tube_; }
  /// The tube that the motion at t was certified for. It is the tube of the newest request up to t that was answered by
  /// an adopted plan or by KeepCommitted. Without such a request, and after rejoin(), it is tube().
  [[nodiscard]] Vec3 tube_at(UTime t) const;
  /// Commits to a braking trajectory from the measured state, because the vehicle is outside its tube. The open request
  /// is closed. The next request, which reports this trajectory to the vehicle, is due at once. Until the trajectory is
  /// at rest, the limits and the flight box of requests are widened as far as it needs.
  void rejoin(const UavState& measured);
  /// Removes the plan that was adopted last if no request has contained it and it starts after `last_setpoint`, the
  /// time of the newest setpoint. Then the vehicle has no knowledge of that plan, and continues along the trajectory
  /// before it.
  /// @return whether there was such a plan
  bool drop_unsent_plan(UTime last_setpoint);
  /// Sets the mode of the newest goal; nullopt: no goal was received.
  void set_mode(std::optional<GoalMode> mode) { mode_ = mode; }
  /// Sets the largest velocity of the next requests, per axis of W, m/s; nullopt: that of the vehicle. While the
  /// committed trajectory is faster, no requests are made. It ends at rest, so that is over when the vehicle has
  /// braked.
  void set_speed_limit(const std::optional<Vec3>& v_max) { speed_limit_ = v_max; }

  /// Returns the request that is due at `now`, with an empty header, or nullopt if none is due.
  std::optional<HorizonRequest> next_request(UTime now);
  /// Returns when next_request() is to be called, or nullopt while no requests are made.
  [[nodiscard]] std::optional<UTime> next_wakeup() const;
  /// Decides on a plan received at `now`. An adopted plan is in force from its t_s on. Every plan is counted.
  Adoption consider(const Plan& plan, UTime now);

  /// The committed motion at t.
  [[nodiscard]] MotionSample sample(UTime t) const { return committed_.sample(t); }
  /// The committed motion just after t. It differs from sample() at a joint, where the jerk jumps.
  [[nodiscard]] MotionSample sample_after(UTime t) const;
  [[nodiscard]] const CommittedTrajectory& committed() const { return committed_; }
  /// The committed motion between two times (CommittedTrajectory::pieces).
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const { return committed_.pieces(from, to); }
  /// Drops the memory of times before t. Later calls must not ask for them.
  void forget_before(UTime t);
  [[nodiscard]] bool at_rest(UTime t) const { return t >= committed_.end(); }
  /// Whether requests are made: the vehicle follows, and the newest goal has a mode other than Stop.
  [[nodiscard]] bool requests_plans() const { return requests_from_ && mode_ && *mode_ != GoalMode::Stop; }
  [[nodiscard]] const ExecutorCounters& counters() const { return counters_; }

 private:
  /// A closed request. It is remembered to recognize a late or a second answer.
  struct Closed {
    std::int64_t id = 0;
    UTime t_s;
    bool answered = false;
  };
  /// A tube that holds from a time on.
  struct TubeFrom {
    UTime from;
    Vec3 tube;
  };
  /// The vehicle's limits times share_, or the largest values of `committed` after `from` where those are larger. The
  /// speed limit cuts both.
  [[nodiscard]] Limits limits_for(const TimedSpline& committed, UTime from) const;
  /// Whether `committed` is faster than the speed limit after `from`.
  [[nodiscard]] bool is_too_fast(const TimedSpline& committed, UTime from) const;
  /// The flight box, enlarged where `committed` leaves it.
  [[nodiscard]] Box flight_box_for(const TimedSpline& committed) const;
  [[nodiscard]] Adoption judge(const Plan& plan, UTime now);
  [[nodiscard]] Verdict judge_closed(std::int64_t id, UTime now);
  void close_expired(UTime now);
  void close(bool answered);

  Limits limits_;
  std::optional<Vec3> speed_limit_;
  Body body_;
  Box flight_box_;
  Duration period_, lead_;
  CommittedTrajectory committed_;
  UTime sent_start_;  ///< start of the newest segment that a request has contained
  Vec3 tube_ = Vec3::Zero();
  double share_ = 1.0;
  std::deque<TubeFrom> tubes_;  ///< ascending
  std::optional<UTime> requests_from_;
  std::optional<GoalMode> mode_;
  std::optional<HorizonRequest> outstanding_;
  std::optional<UTime> last_request_;
  std::deque<Closed> closed_;
  ExecutorCounters counters_;
};

}  // namespace tern
