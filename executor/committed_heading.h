// The heading that the vehicle turns along: adopted with its plan, or none.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/world/heading.h"
#include "core/world/horizon.h"

namespace tern {

/// The executor's decision on one PLAN_HEADING.
enum class HeadingVerdict : std::uint8_t {
  Adopted = 0,      ///< the vehicle turns along it from its start on
  UnknownPlan = 1,  ///< refused: its request is not the one answered last, or the plan was refused
  Late = 2,         ///< refused: received at or after its start
  OffKnots = 3,     ///< refused: its start is not t_s, or its knots differ from those of the plan
  Unflyable = 4,    ///< refused: it breaks a rule of heading_breach()
};
inline constexpr int kHeadingVerdicts = 5;
/// Returns "adopted", "late" …
const char* to_string(HeadingVerdict verdict);

/// A verdict with its details.
struct HeadingAdoption {
  HeadingVerdict verdict = HeadingVerdict::Adopted;
  std::string detail = {};  ///< of a refusal
  HeadingBreach breach = HeadingBreach::None;
};

struct HeadingCounters {
  std::array<std::int64_t, kHeadingVerdicts> verdicts = {};
  std::array<std::int64_t, kHeadingBreaches> breaches = {};  ///< the unflyable ones
  std::int64_t started_anew = 0;                             ///< adopted where no heading was in force

  [[nodiscard]] std::int64_t of(HeadingVerdict verdict) const { return verdicts[idx(verdict)]; }
  [[nodiscard]] std::int64_t of(HeadingBreach breach) const { return breaches[idx(breach)]; }
};

/// The headings in force over time. Pure: times are arguments.
///
/// | event                                    | effect                                                                |
/// |------------------------------------------|-----------------------------------------------------------------------|
/// | a plan is adopted                        | from its t_s on no heading is in force, until its heading is adopted  |
/// | the committed trajectory is kept         | the heading in force stays                                            |
/// | the heading of the answer received last  | adopted from t_s on, if it keeps the limits and joins the heading     |
/// |                                          | that is in force before t_s                                           |
/// | the same, where no heading is in force   | adopted with any start: the yaw turns to it within its limits         |
/// | the same, but it breaks a rule           | refused: from t_s on no heading is in force                           |
/// | any other heading                        | refused                                                               |
///
/// A planner does not learn of a refusal. Its next heading is adopted as one where none is in force, and the one after
/// that joins it.
class CommittedHeading {
 public:
  explicit CommittedHeading(const HeadingLimits& limits) : limits_(limits) {}

  /// A plan was adopted that answers the request with this t_s.
  void on_adopted(const Plan& plan, UTime t_s);
  /// The committed trajectory was kept by this answer.
  void on_kept(const Plan& plan, UTime t_s);
  /// Decides on a heading received at `now`. Every heading is counted.
  HeadingAdoption consider(const PlanHeading& heading, UTime now);

  /// Returns the yaw at t; nullopt if no heading is in force.
  [[nodiscard]] std::optional<YawSample> sample(UTime t) const;
  /// Removes what begins at t or later: its plan was dropped.
  void drop_from(UTime t);
  /// Removes everything: the vehicle rejoins, or the flight begins anew.
  void clear();
  /// Drops the memory of times before t.
  void forget_before(UTime t);
  [[nodiscard]] const HeadingCounters& counters() const { return counters_; }
  [[nodiscard]] const HeadingLimits& limits() const { return limits_; }

 private:
  struct Segment {
    UTime from;
    std::optional<HeadingSpline> heading;  ///< nullopt: none is in force
  };
  /// The answer whose heading may come.
  struct Awaited {
    std::int64_t request_id = 0;
    MessageName request;
    UTime t_s;
    Duration interval;
    std::size_t control_points = 0;
  };
  void await(const Plan& plan, UTime t_s);
  [[nodiscard]] HeadingAdoption judge(const PlanHeading& heading, UTime now);
  /// Returns the yaw at t of the heading in force at `latest`; nullopt if none was.
  [[nodiscard]] std::optional<YawSample> sample_from(UTime latest, UTime t) const;
  void begin(UTime from, std::optional<HeadingSpline> heading);

  HeadingLimits limits_;
  std::deque<Segment> segments_;  ///< ascending
  std::optional<Awaited> awaited_;
  HeadingCounters counters_;
};

}  // namespace tern
