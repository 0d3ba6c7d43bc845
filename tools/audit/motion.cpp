// Limits, continuity at every splice, and whether what was commanded is what was committed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/audit/audit.h"
#include "tools/audit/body_gap.h"
#include "tools/audit/commitment.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

constexpr char kAxes[] = {'x', 'y', 'z'};
/// Extrema are enclosed to this share of the limit, well below kLimitTolerance.
constexpr double kExtremumShare = 1e-8;
constexpr double kDegrees = 180.0 / M_PI;
/// Rounding of a derivative that is computed in two ways, m, m/s, m/s²; joins are accepted up to kJoinTolerance.
constexpr double kJoinRounding = 1e-8;

struct Quantity {
  const char* name;
  const char* unit;
  int order;
  const Vec3& limit;
};

/// Returns the largest magnitude of a derivative of one axis on a curve.
double largest(const Curve& curve, int axis, int order, double tolerance) {
  Cubic cubic = curve.axis[idx(axis)];
  for (int k = 0; k < order; ++k) cubic = cubic.derivative();
  const Enclosure e = enclose(cubic, 0.0, curve.length_s(), tolerance);
  return std::max(std::abs(e.low), std::abs(e.high));
}

class LimitCheck {
 public:
  explicit LimitCheck(Check& check) : check_(check) {}

  void plan(const Plan& plan, const HorizonRequest& request) {
    const std::vector<Curve> curves = curves_of(plan.trajectory);
    const Limits& l = request.limits;
    for (const Quantity& q : {Quantity{"speed", "m/s", 1, l.v_max}, Quantity{"acceleration", "m/s2", 2, l.a_max},
                              Quantity{"jerk", "m/s3", 3, l.j_max}}) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(q.limit[axis])) continue;
        double value = 0.0;
        for (const Curve& c : curves)
          value = std::max(value, largest(c, axis, q.order, kExtremumShare * q.limit[axis]));
        demand(plan.trajectory.start, request.id, q, axis, value);
      }
    }
    if (l.dynamics) dynamics(plan.trajectory.start, request.id, *l.dynamics, curves);
    Box box;
    for (const Curve& c : curves) box.extend(enclose(c, 0.0, c.length_s(), kBoxTolerance * 0.1));
    inside(plan.trajectory.start, request, box, request.tube);
  }

  /// Only a vehicle without tube is checked: a real one is limited by its physics.
  void state(const UavState& state, const HorizonRequest& request) {
    inside(state.at, request, Box(state.motion.p, state.motion.p), Vec3::Zero());
    if (!request.tube.isZero(0.0)) return;
    const Limits& l = request.limits;
    const Vec3 values[] = {state.motion.v, state.motion.a, state.motion.j};
    const Quantity quantities[] = {{"flown speed", "m/s", 1, l.v_max},
                                   {"flown acceleration", "m/s2", 2, l.a_max},
                                   {"flown jerk", "m/s3", 3, l.j_max}};
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) demand(state.at, 0, quantities[k], axis, std::abs(values[k][axis]));
    }
  }

  [[nodiscard]] double used(int order) const { return used_[order]; }

 private:
  void demand(UTime at, std::int64_t request, const Quantity& q, int axis, double value) {
    ++check_.checked;
    used_[q.order] = std::max(used_[q.order], value / q.limit[axis]);
    if (value <= q.limit[axis] * (1.0 + kLimitTolerance + 2.0 * kExtremumShare)) return;
    check_.fail(
        {at, fmt::format("{} {} {:.6g} {} beyond {:.6g}", q.name, kAxes[axis], value, q.unit, q.limit[axis]), request});
  }

  /// Checks thrust, tilt and body rates of a multirotor. |f|² is a parabola in time, and j is constant. The body turns
  /// fastest where |f| is least.
  void dynamics(UTime at, std::int64_t request, const Dynamics& d, const std::vector<Curve>& curves) {
    const Vec3 up(0.0, 0.0, kGravity);
    for (const Curve& c : curves) {
      const Vec3 first = c.a(0.0) + up;
      const Vec3 last = c.a(c.length_s()) + up;
      const Vec3 j = c.j(0.0);
      const double vertex = j.isZero(0.0) ? 0.0 : std::clamp(-first.dot(j) / j.squaredNorm(), 0.0, c.length_s());
      const Vec3 lowest = first + vertex * j;
      const Vec3 z = lowest.normalized();
      const double tilt = std::acos(std::min(first.normalized().z(), last.normalized().z()));
      require(at, request, "thrust", d.thrust_min / lowest.norm(), "below the least allowed, as a share");
      require(at, request, "thrust", std::max(first.norm(), last.norm()) / d.thrust_max, "of the largest allowed");
      require(at, request, "tilt", tilt * kDegrees / d.tilt_max_deg, "of the largest allowed");
      require(at, request, "body rate", (j - j.dot(z) * z).norm() / lowest.norm() * kDegrees / d.body_rate_max_deg_s,
              "of the largest allowed");
    }
  }

  /// @param share  of the limit
  void require(UTime at, std::int64_t request, const char* what, double share, const char* of) {
    ++check_.checked;
    if (share <= 1.0 + kLimitTolerance + 2.0 * kExtremumShare) return;
    check_.fail({at, fmt::format("{} is {:.7g} {}", what, share, of), request});
  }

  /// @param off  greatest distance of the true position from these, m
  void inside(UTime at, const HorizonRequest& request, const Box& positions, const Vec3& off) {
    const Box body = grown(swept_box(request.body, positions), off);
    const Box& room = request.flight_box;
    for (int axis = 0; axis < 3; ++axis) {
      ++check_.checked;
      const double out = std::max(body.max()[axis] - room.max()[axis], room.min()[axis] - body.min()[axis]);
      if (out <= kBoxTolerance * 1.2) continue;
      check_.fail(
          {at, fmt::format("the body leaves the flight box by {:.6g} m along {}", out, kAxes[axis]), request.id});
    }
  }

  Check& check_;
  double used_[4] = {};  ///< greatest share of a limit, by order of derivative
};

void join(UTime at, std::int64_t request, const char* what, const MotionSample& a, const MotionSample& b, Check& check,
          double& worst) {
  ++check.checked;
  const double gap = join_gap(a, b);
  worst = std::max(worst, gap);
  if (gap <= kJoinTolerance + kJoinRounding) return;
  check.fail({at,
              fmt::format("{}: jumps by {:.3g} m, {:.3g} m/s, {:.3g} m/s2", what, (a.p - b.p).norm(),
                          (a.v - b.v).norm(), (a.a - b.a).norm()),
              request});
}

void ends_at_rest(const Plan& plan, const std::vector<Curve>& curves, Check& check) {
  ++check.checked;
  const Curve& last = curves.back();
  const double s = last.length_s();
  if (std::max(last.v(s).norm(), last.a(s).norm()) <= kJoinTolerance) return;
  check.fail({plan.trajectory.start,
              fmt::format("ends with {:.3g} m/s, {:.3g} m/s2, not at rest", last.v(s).norm(), last.a(s).norm()),
              plan.request_id});
}

/// Returns true if an answer kept the trajectory. Its certificate is then checked like any other.
bool is_kept(const FlightRecord& record, const Commitment& commitment) {
  return std::any_of(record.plans.begin(), record.plans.end(), [&](const Plan& plan) {
    return plan.outcome == PlanOutcome::KeepCommitted && same(plan.trajectory, commitment.spline);
  });
}

}  // namespace

Check check_limits(const FlightRecord& record) {
  Check check{.name = "limits", .claim = "every plan and every state kept speed, acceleration, jerk and flight box"};
  LimitCheck limits(check);
  for (const Plan& plan : record.plans) {
    if (!brings_trajectory(plan)) continue;
    const HorizonRequest* request = record.request(plan.inputs.request);
    if (request == nullptr) {
      ++check.unchecked["plans whose request is not in the log"];
    } else {
      limits.plan(plan, *request);
    }
  }
  if (!record.requests.empty()) {
    const Window window = judged_window(record);
    for (const UavState& state : record.states) {
      if (window.contains(state.at)) limits.state(state, record.requests.front());
    }
  }
  check.summary = fmt::format("at most {:.1f} % of the speed, {:.1f} % of the acceleration allowed",
                              limits.used(1) * 100.0, limits.used(2) * 100.0);
  check.measures = {{"speed_share", limits.used(1)}, {"acceleration_share", limits.used(2)}};
  return check;
}

Check check_continuity(const FlightRecord& record) {
  Check check{.name = "continuity", .claim = "plans join the committed trajectory at every splice and end at rest"};
  double worst = 0.0;
  for (const HorizonRequest& r : record.requests) {
    join(r.t_s, r.id, "the request's start leaves the committed trajectory", r.start,
         motion_at(curves_of(r.committed), r.t_s), check, worst);
  }
  for (const Plan& plan : record.plans) {
    if (!brings_trajectory(plan)) continue;
    const std::vector<Curve> curves = curves_of(plan.trajectory);
    ends_at_rest(plan, curves, check);
    const HorizonRequest* request = record.request(plan.inputs.request);
    if (request == nullptr) {
      ++check.unchecked["plans whose request is not in the log"];
      continue;
    }
    if (plan.trajectory.start != request->t_s) {
      check.fail({plan.trajectory.start, "the plan does not start at its request's t_s", plan.request_id});
      continue;
    }
    join(request->t_s, plan.request_id, "the plan leaves the committed trajectory", motion_at(curves, request->t_s),
         motion_at(curves_of(request->committed), request->t_s), check, worst);
  }
  std::int64_t splices = 0;
  for (const Commitments& own : commitments(record)) {
    for (std::size_t k = 1; k < own.list.size(); ++k) {
      if (own.list[k].after_gap) {
        ++check.unchecked["splices between requests that were lost"];
        continue;
      }
      if (own.list[k].is_stop) {
        ++check.unchecked["braking trajectories from a measured state: the vehicle was off the committed trajectory"];
        continue;
      }
      const UTime at = own.list[k].spline.start;
      join(at, own.list[k].request, "the splice", motion_at(own.list[k].curves, at),
           motion_at(own.list[k - 1].curves, at), check, worst);
      ++splices;
    }
  }
  check.summary = fmt::format("{} splices, the largest jump is {:.2g} (m, m/s, m/s2 per axis)", splices, worst);
  check.measures = {{"splices", static_cast<double>(splices)}, {"worst_jump", worst}};
  return check;
}

namespace {

// The time from which on no request is known, since the log has a silence after its last one: what was lost has no
// later sequence number that would show it.
std::optional<UTime> requests_unknown_since(const FlightRecord& record) {
  const auto& spans = record.contents.spans;
  for (std::size_t k = 1; k < spans.size(); ++k) {
    if (spans[k].first > record.requests.back().deadline.us) return UTime{spans[k - 1].second};
  }
  return std::nullopt;
}

}  // namespace

Check check_commitment(const FlightRecord& record) {
  Check check{.name = "commitment", .claim = "setpoints lie on the committed trajectory, which is a plan of the log"};
  const std::vector<Commitments> all = commitments(record);
  const bool plans_unread = record.unread(channels::kPlan.name) > 0;
  const bool states_unread = record.unread(channels::kUavState.name) > 0;
  const bool requests_unread = record.unread(channels::kHorizonRequest.name) > 0;
  for (const Commitments& own : all) {
    for (std::size_t k = 1; k < own.list.size(); ++k) {
      ++check.checked;
      if (own.list[k].request != 0) continue;
      if (own.list[k].is_stop) {
        const char* const since = is_kept(record, own.list[k]) ? "before the next answer" : "at all";
        ++check.unchecked[fmt::format("braking trajectories from a measured state, not certified by a plan {}", since)];
      } else if (plans_unread) {
        ++check.unchecked["committed trajectories whose plan may be among the PLANs that were lost or refused"];
      } else if (states_unread) {
        ++check.unchecked["committed trajectories that may start from a UAV_STATE that was lost or refused"];
      } else {
        check.fail({own.list[k].spline.start, "flies a trajectory that is not in a plan of the log"});
      }
    }
  }
  if (all.size() > 1)
    check.unchecked["setpoints: several executors sent requests"] = static_cast<std::int64_t>(all.size());
  double worst = 0.0;
  if (all.size() == 1) {
    const Window window = judged_window(record);
    const auto unknown_since = requests_unknown_since(record);
    for (const UavState& s : record.setpoints) {
      if (!window.contains(s.at)) continue;
      if (s.at < all.front().list.front().spline.start) {
        ++check.unchecked["setpoints from before the first request in the log"];
        continue;
      }
      ++check.checked;
      const double gap = join_gap(s.motion, motion_at(all.front().at(s.at).curves, s.at));
      worst = std::max(worst, gap);
      if (gap <= kJoinTolerance) continue;
      if (requests_unread || (unknown_since && s.at >= *unknown_since)) {
        ++check.unchecked["setpoints that may follow a trajectory whose requests were lost"];
      } else {
        check.fail({s.at, fmt::format("the setpoint is {:.3g} off the committed trajectory", gap)});
      }
    }
  }
  check.summary = fmt::format("setpoints within {:.2g} of it", worst);
  check.measures = {{"worst_setpoint", worst}};
  return check;
}

}  // namespace tern::audit
