#include "campaign/app/plan_tracer.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/world/names.h"
#include "monitor/flight_summary.h"

namespace tern {

void PlanTracer::on_plan(const Plan& p) {
  const Points& q = p.trajectory.control_points;
  const Vec3 end = q.col(q.cols() - 1);
  const MotionSample& s = request_.start;
  const auto text = [](const Vec3& v) { return fmt::format("{:.2f} {:.2f} {:.2f}", v.x(), v.y(), v.z()); };
  fmt::print(stderr, "{:.3f} p {} v {} {} reason {} lasts {:.2f} ends {} goal {} hold {:.2f} confidence {:.2f}{}{}\n",
             static_cast<double>(request_.t_s.us) * 1e-6, text(s.p), text(s.v), key(p.outcome),
             static_cast<int>(p.reason), p.trajectory.interval.seconds() * static_cast<double>(q.cols() - 3), text(end),
             text(p.local_goal), p.hold.seconds(), p.confidence,
             (p.alpha_scale < 1.0 ? fmt::format(" alpha x {:.2f}", p.alpha_scale) : "") +
                 (p.sure_for < kMaxSpan ? fmt::format(" for {:.2f}", p.sure_for.seconds()) : ""),
             p.relaxed ? " relaxed" : "");
}

}  // namespace tern
