// What flies plans: asks for a horizon, adopts the answer or says why not, and always has a way to rest.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "core/base/knobs.h"
#include "core/world/goal.h"
#include "core/world/scenario.h"
#include "executor/adoption.h"
#include "executor/committed_trajectory.h"
#include "executor/tube.h"
#include "executor/yaw_follower.h"

namespace tern {

struct ExecutorConfig {
  double rate_hz = 20.0;
  Duration lead{75'000};  ///< > kDeadlineLead, ≤ 5 s
  double tube_m = 0.0;    ///< [0, kMaxTube]
  YawFollowerConfig heading = {};

  template <typename V>
  void visit(V& v) {
    v("rate_hz", rate_hz, Range{1e-3, 100.0}, "requests per second at most");
    v("lead_s", lead, Range{0.01, 2.0}, "t_s − the time of the request, s; the planner has this less 5 ms");
    v("tube_m", tube_m, Range{0.0, kMaxTube},
      "requests promise that the vehicle is at most this far off its setpoints, m per axis; more where more is "
      "measured");
    v("heading", heading);
  }
};

/// Everything is counted; nothing is counted twice: requests = answered_in_time + unanswered + (0 or 1 outstanding).
struct ExecutorCounters {
  std::int64_t requests = 0;
  std::int64_t answered_in_time = 0;                  ///< whatever the answer's verdict
  std::int64_t unanswered = 0;                        ///< closed by their deadline
  std::array<std::int64_t, kVerdicts> verdicts = {};  ///< plans by Verdict; late, twice, unknown ones among them
  std::array<std::int64_t, kBreaches> breaches = {};  ///< of the unflyable ones, by Breach

  [[nodiscard]] std::int64_t of(Verdict verdict) const { return verdicts[idx(verdict)]; }
  [[nodiscard]] std::int64_t of(Breach breach) const { return breaches[idx(breach)]; }
  [[nodiscard]] std::int64_t late() const { return of(Verdict::Late) + of(Verdict::TooLate); }
  [[nodiscard]] std::int64_t answered_twice() const { return of(Verdict::AnsweredTwice); }
  [[nodiscard]] std::int64_t refused() const;
};

/// Holds the committed trajectory, makes requests, adopts plans. Pure: times are arguments and never go back.
///
/// One request is outstanding at most; the next one goes out after its answer or its deadline, at no more than rate_hz.
/// An answer is in time when now ≤ deadline; from then on the request is closed. Nothing is asked before begin()'s
/// time, after pause(), without a mode, or in mode Stop. At rest it goes on asking: a vehicle at rest must be able to
/// evade.
class Executor {
 public:
  /// At rest at uav.start from `now` on. @throws std::invalid_argument when config is out of its ranges.
  Executor(const UavSpec& uav, UTime now, const ExecutorConfig& config = {});
  /// At the measured state, and from there to rest (braking_trajectory). The same @throws.
  Executor(const UavSpec& uav, const UavState& measured, const ExecutorConfig& config = {});

  /// The vehicle follows: the mission may ask from `go` on.
  void begin(UTime go) { requests_from_ = go; }
  /// It no longer does. What is committed stays so.
  void pause() { requests_from_.reset(); }
  /// What requests promise from now on (HorizonRequest::tube), and the share of the vehicle's limits that they ask for.
  /// @pre 0 < share ≤ 1
  void set_tube(const Vec3& tube, double share = 1.0);
  [[nodiscard]] const Vec3& tube() const { return tube_; }
  /// What was promised of time t: the tube of the request whose plan was adopted last before it, or that was answered
  /// by the committed trajectory. Before the first one, and after rejoin(), that of the next request.
  [[nodiscard]] Vec3 tube_at(UTime t) const;
  /// The vehicle is not where it was committed to be: from here on it is committed to come to rest from the measured
  /// state. The open request is closed, and the next one, by which the vehicle hears of it, goes out at once. Until
  /// that rest, limits and flight box are as wide as the way to it needs.
  void rejoin(const UavState& measured);
  /// The plan that was adopted last is not flown after all, if no request has carried it and it starts after `said`,
  /// the newest setpoint. The vehicle cannot have heard of it, and flies on along what it has heard.
  /// @return whether there was one
  bool drop_unsent_plan(UTime said);
  /// What the newest goal wants; nullopt: no goal yet.
  void set_mode(std::optional<GoalMode> mode) { mode_ = mode; }

  /// The request that is due at `now`, with an empty header. @return nullopt if none is due
  std::optional<HorizonRequest> next_request(UTime now);
  /// When next_request() wants to be called. @return nullopt if there is nothing to ask
  [[nodiscard]] std::optional<UTime> next_wakeup() const;
  /// Judges a plan that came at `now`, and flies it from its t_s on if it may be flown. Counted, whatever it is.
  Adoption consider(const Plan& plan, UTime now);

  [[nodiscard]] MotionSample sample(UTime t) const { return committed_.sample(t); }
  /// The same, at a joint with the jerk of what follows: the cubic that begins at t.
  [[nodiscard]] MotionSample sample_after(UTime t) const;
  [[nodiscard]] const CommittedTrajectory& committed() const { return committed_; }
  /// The committed curve between two times (see CommittedTrajectory::pieces).
  [[nodiscard]] PiecewiseCubic pieces(UTime from, UTime to) const { return committed_.pieces(from, to); }
  /// No one will ask for times before t any more.
  void forget_before(UTime t);
  [[nodiscard]] bool at_rest(UTime t) const { return t >= committed_.end(); }
  /// Whether requests go out: the vehicle follows, and the newest goal wants to be flown to.
  [[nodiscard]] bool requests_plans() const { return requests_from_ && mode_ && *mode_ != GoalMode::Stop; }
  [[nodiscard]] const ExecutorCounters& counters() const { return counters_; }

 private:
  /// A request that is closed, so that a late or second answer is known for what it is.
  struct Closed {
    std::int64_t id = 0;
    UTime t_s;
    bool answered = false;
  };
  struct TubeFrom {
    UTime from;
    Vec3 tube;
  };
  /// The share of the vehicle's limits, or what is left of the trajectory needs where that is more (see rejoin).
  [[nodiscard]] Limits limits_for(const TimedSpline& committed, UTime from) const;
  /// The flight box, or a larger one where the trajectory is already outside.
  [[nodiscard]] Box flight_box_for(const TimedSpline& committed) const;
  [[nodiscard]] Adoption judge(const Plan& plan, UTime now);
  [[nodiscard]] Verdict judge_closed(std::int64_t id, UTime now);
  void close_expired(UTime now);
  void close(bool answered);

  Limits limits_;
  Body body_;
  Box flight_box_;
  Duration period_, lead_;
  CommittedTrajectory committed_;
  UTime sent_start_;  ///< the start of the newest segment that the vehicle may have heard of
  Vec3 tube_ = Vec3::Zero();
  double share_ = 1.0;
  std::deque<TubeFrom> tubes_;
  std::optional<UTime> requests_from_;
  std::optional<GoalMode> mode_;
  std::optional<HorizonRequest> outstanding_;
  std::optional<UTime> last_request_;
  std::deque<Closed> closed_;
  ExecutorCounters counters_;
};

}  // namespace tern
