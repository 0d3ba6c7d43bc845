#include "tools/audit/commitment.h"

#include <algorithm>
#include <iterator>

namespace tern::audit {
namespace {

/// Intervals of a braking trajectory, and those in which its acceleration may set in and end.
constexpr std::size_t kStopIntervals = 16;
constexpr int kRamps[] = {1, 2, 4, 8};
constexpr double kSameAcceleration = 1e-3;  ///< m/s²
/// Most age of the state that a braking trajectory starts from.
constexpr Duration kMaxAhead{1'000'000};

/// Returns true if the acceleration fades within a ramp, and another one takes its place that is constant per axis
/// except for such ramps.
bool brakes(const std::vector<Curve>& curves) {
  if (curves.size() != kStopIntervals) return false;
  const Vec3 first = curves.front().a(0.0), middle = curves[kStopIntervals / 2].a(0.0);
  return std::any_of(std::begin(kRamps), std::end(kRamps), [&](int ramp) {
    for (std::size_t k = 0; k < kStopIntervals; ++k) {
      const double come = static_cast<double>(k) / ramp, go = static_cast<double>(kStopIntervals - k) / ramp;
      const Vec3 expected = std::max(0.0, 1.0 - come) * first + std::min({1.0, come, go}) * middle;
      if ((curves[k].a(0.0) - expected).cwiseAbs().maxCoeff() > kSameAcceleration) return false;
    }
    return true;
  });
}

void adopt_last(const FlightRecord& record, const HorizonRequest& last, Commitments& own) {
  for (const Plan& plan : record.plans) {
    if (plan.inputs.request != last.header.name || !brings_trajectory(plan)) continue;
    std::vector<Curve> curves = curves_of(plan.trajectory);
    for (const UavState& s : record.setpoints) {
      if (s.at < plan.trajectory.start ||
          join_gap(s.motion, motion_at(own.list.back().curves, s.at)) <= kJoinTolerance) {
        continue;
      }
      const bool flown = join_gap(s.motion, motion_at(curves, s.at)) <= kJoinTolerance;
      if (flown) own.list.push_back({plan.trajectory, std::move(curves), plan.request_id, false, false, s.at});
      return;
    }
  }
}

}  // namespace

bool is_stop(const std::vector<UavState>& estimates, const TimedSpline& spline) {
  const std::vector<Curve> curves = curves_of(spline);
  if (!spline.spline().ends_at_rest() || !brakes(curves)) return false;
  const MotionSample first = motion_at(curves, spline.start);
  const auto before = [](const UavState& s, UTime t) { return s.at < t; };
  const auto from = std::lower_bound(estimates.begin(), estimates.end(), spline.start - kMaxAhead, before);
  const auto to = std::lower_bound(from, estimates.end(), spline.start + Duration{1}, before);
  return std::any_of(from, to, [&](const UavState& s) {
    const double later_s = (spline.start - s.at).seconds();
    MotionSample there = s.motion;
    there.p += later_s * (s.motion.v + 0.5 * later_s * s.motion.a);
    there.v += later_s * s.motion.a;
    return join_gap(there, first) <= kJoinTolerance;
  });
}

const Commitment& Commitments::at(UTime t) const {
  const auto next = std::ranges::upper_bound(list, t, {}, [](const Commitment& c) { return c.spline.start; });
  return next == list.begin() ? list.front() : *std::prev(next);
}

std::vector<Commitments> commitments(const FlightRecord& record) {
  std::vector<Commitments> all;
  std::vector<const HorizonRequest*> last;
  for (const HorizonRequest& request : record.requests) {
    const std::int64_t executor = request.header.name.sender_epoch_us;
    const auto known = std::ranges::find_if(all, [&](const Commitments& c) { return c.executor == executor; });
    const auto k = idx(known - all.begin());
    if (known == all.end()) {
      all.push_back({executor, {}});
      last.push_back(nullptr);
    }
    const bool gap = last[k] != nullptr && request.header.name.sequence != last[k]->header.name.sequence + 1;
    last[k] = &request;
    Commitments& own = all[k];
    if (!own.list.empty() && same(own.list.back().spline, request.committed)) {
      own.list.back().known_until = std::max(own.list.back().known_until, request.t_s);
      continue;
    }
    Commitment next{request.committed, curves_of(request.committed), 0, gap, false, request.t_s};
    for (const Plan& plan : record.plans) {
      if (brings_trajectory(plan) && same(plan.trajectory, request.committed)) next.request = plan.request_id;
    }
    next.is_stop = next.request == 0 && !own.list.empty() && is_stop(record.estimates, next.spline);
    while (next.is_stop && !own.list.empty() && own.list.back().spline.start >= next.spline.start) own.list.pop_back();
    own.list.push_back(std::move(next));
  }
  for (std::size_t k = 0; k < all.size(); ++k) adopt_last(record, *last[k], all[k]);
  return all;
}

bool same(const TimedSpline& a, const TimedSpline& b) {
  return a.start == b.start && a.interval == b.interval && a.control_points.cols() == b.control_points.cols() &&
         a.control_points == b.control_points;
}

double join_gap(const MotionSample& a, const MotionSample& b) {
  return std::max(
      {(a.p - b.p).cwiseAbs().maxCoeff(), (a.v - b.v).cwiseAbs().maxCoeff(), (a.a - b.a).cwiseAbs().maxCoeff()});
}

}  // namespace tern::audit
