// Whether each PLAN_HEADING keeps its limits, ends at rate 0 and joins the heading before, and what was flown of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tools/audit/audit.h"
#include "tools/audit/commitment.h"
#include "tools/audit/cubic.h"

namespace tern::audit {
namespace {

/// A limit counts as kept up to this share, as for plans.
constexpr double kMore = 1.0 + 1e-6;
/// A setpoint is on a heading, and a heading joins, within this, rad and rad/s.
constexpr double kSameYaw = 1e-6;
/// Tolerance of the enclosures as a share of the limit.
constexpr double kEnclosed = 1e-7;

/// The yaw as the x of a motion.
std::vector<Curve> yaw_curves(const PlanHeading& heading) {
  TimedSpline spline{heading.start, heading.interval,
                     Points::Zero(3, static_cast<Eigen::Index>(heading.control_points.size()))};
  for (std::size_t k = 0; k < heading.control_points.size(); ++k) {
    spline.control_points(0, static_cast<Eigen::Index>(k)) = heading.control_points[k];
  }
  return curves_of(spline);
}

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)); }

/// The largest magnitude of a derivative of the yaw.
double largest(const std::vector<Curve>& curves, int order, double tolerance) {
  double most = 0.0;
  for (const Curve& curve : curves) {
    const Cubic rate = curve.axis[0].derivative();
    const Enclosure e = enclose(order == 1 ? rate : rate.derivative(), 0.0, curve.length_s(), tolerance);
    most = std::max({most, -e.low, e.high});
  }
  return most;
}

class HeadingCheck {
 public:
  HeadingCheck(const FlightRecord& record, Check& check) : record_(record), check_(check) {
    for (const Plan& plan : record.plans) plans_.emplace(plan.inputs.request, &plan);
  }

  void judge(const PlanHeading& heading) {
    const auto plan = plans_.find(heading.request);
    const HorizonRequest* request = record_.request(heading.request);
    if (plan == plans_.end() || request == nullptr) {
      ++check_.unchecked["headings whose plan or request is not in the log"];
      return;
    }
    ++check_.checked;
    const std::vector<Curve> curves = yaw_curves(heading);
    limits(heading, curves);
    const TimedSpline& trajectory = plan->second->trajectory;
    const auto points = static_cast<std::size_t>(trajectory.control_points.cols());
    if (heading.start != request->t_s || heading.interval != trajectory.interval ||
        heading.control_points.size() != points) {
      fail(heading, "does not start at t_s on the knots of its plan");
    }
    join(heading, curves, *request);
    sent_[heading.header.name.sender_epoch_us].push_back({&trajectory, curves});
  }

  /// Counts the setpoints on the newest heading that has begun.
  void flown() {
    std::vector<std::pair<UTime, std::vector<Curve>>> headings;
    for (const PlanHeading& heading : record_.headings) headings.emplace_back(heading.start, yaw_curves(heading));
    std::ranges::stable_sort(headings, {}, [](const auto& h) { return h.first; });
    std::size_t next = 0;
    for (const UavState& setpoint : record_.setpoints) {
      while (next < headings.size() && headings[next].first <= setpoint.at) ++next;
      if (next == 0) continue;
      ++setpoints_;
      const double yaw = motion_at(headings[next - 1].second, setpoint.at).p.x();
      if (turn_between(yaw, setpoint.yaw) <= kSameYaw) ++on_heading_;
    }
  }

  void summarize() {
    const double share = setpoints_ > 0 ? static_cast<double>(on_heading_) / static_cast<double>(setpoints_) : 0.0;
    check_.summary = fmt::format(
        "{} headings, {} of them begin anew; largest {:.1f} deg/s and {:.1f} deg/s2; {:.1f} % of the setpoints on them",
        check_.checked, anew_, rate_ * 180.0 / std::numbers::pi, acceleration_ * 180.0 / std::numbers::pi,
        share * 100.0);
    check_.measures = {{"begun_anew", static_cast<double>(anew_)},
                       {"largest_rate_rad_s", rate_},
                       {"largest_acceleration_rad_s2", acceleration_},
                       {"setpoints_on_heading", share}};
  }

 private:
  struct Sent {
    const TimedSpline* trajectory;
    std::vector<Curve> curves;
  };

  void limits(const PlanHeading& heading, const std::vector<Curve>& curves) {
    const double rate = largest(curves, 1, heading.rate_max * kEnclosed);
    const double acceleration = largest(curves, 2, heading.acceleration_max * kEnclosed);
    rate_ = std::max(rate_, rate);
    acceleration_ = std::max(acceleration_, acceleration);
    if (rate > heading.rate_max * kMore) {
      fail(heading, fmt::format("turns at {:.6g} rad/s, its limit is {:.6g}", rate, heading.rate_max));
    }
    if (acceleration > heading.acceleration_max * kMore) {
      fail(heading,
           fmt::format("accelerates at {:.6g} rad/s2, its limit is {:.6g}", acceleration, heading.acceleration_max));
    }
    const double left = std::abs(curves.back().v(curves.back().length_s()).x());
    if (left > kSameYaw) fail(heading, fmt::format("still turns at {:.3g} rad/s at its end", left));
  }

  /// A heading continues the newest one that the same planner sent for the committed trajectory.
  void join(const PlanHeading& heading, const std::vector<Curve>& curves, const HorizonRequest& request) {
    const std::vector<Sent>& sent = sent_[heading.header.name.sender_epoch_us];
    const auto before =
        std::find_if(sent.rbegin(), sent.rend(), [&](const Sent& s) { return same(*s.trajectory, request.committed); });
    if (before == sent.rend()) {
      ++anew_;
      return;
    }
    const MotionSample from = motion_at(before->curves, heading.start), to = motion_at(curves, heading.start);
    const double turn = turn_between(from.p.x(), to.p.x()), faster = std::abs(from.v.x() - to.v.x());
    if (turn > kSameYaw || faster > kSameYaw) {
      fail(heading, fmt::format("differs from the heading before by {:.3g} rad and {:.3g} rad/s", turn, faster));
    }
  }

  void fail(const PlanHeading& heading, std::string what) {
    check_.fail({heading.start, std::move(what), heading.request_id});
  }

  const FlightRecord& record_;
  Check& check_;
  std::map<MessageName, const Plan*> plans_;        ///< by request
  std::map<std::int64_t, std::vector<Sent>> sent_;  ///< by planner
  std::int64_t anew_ = 0, setpoints_ = 0, on_heading_ = 0;
  double rate_ = 0.0, acceleration_ = 0.0;
};

}  // namespace

Check check_headings(const FlightRecord& record) {
  Check check{.name = "headings", .claim = "each planned heading keeps its limits and joins the one before"};
  HeadingCheck headings(record, check);
  for (const PlanHeading& heading : record.headings) headings.judge(heading);
  headings.flown();
  headings.summarize();
  return check;
}

}  // namespace tern::audit
