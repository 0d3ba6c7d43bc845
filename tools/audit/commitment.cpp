#include "tools/audit/commitment.h"

#include <algorithm>

namespace tern::audit {
namespace {

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
      if (flown) own.list.push_back({plan.trajectory, std::move(curves), plan.request_id, false, s.at});
      return;
    }
  }
}

}  // namespace

const Commitment& Commitments::at(UTime t) const {
  const auto next =
      std::upper_bound(list.begin(), list.end(), t, [](UTime x, const Commitment& c) { return x < c.spline.start; });
  return next == list.begin() ? list.front() : *std::prev(next);
}

std::vector<Commitments> commitments(const FlightRecord& record) {
  std::vector<Commitments> all;
  std::vector<const HorizonRequest*> last;
  for (const HorizonRequest& request : record.requests) {
    const std::int64_t executor = request.header.name.sender_epoch_us;
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const Commitments& c) { return c.executor == executor; });
    const auto k = static_cast<std::size_t>(known - all.begin());
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
    Commitment next{request.committed, curves_of(request.committed), 0, gap, request.t_s};
    for (const Plan& plan : record.plans) {
      if (brings_trajectory(plan) && same(plan.trajectory, request.committed)) next.request = plan.request_id;
    }
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
