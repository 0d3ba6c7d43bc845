#include "planner/fallback.h"

#include <algorithm>
#include <utility>

#include "core/splines/piecewise_cubic.h"
#include "planner/plan_workspace.h"
#include "planner/problem/tuning.h"
#include "planner/safety/checker.h"

namespace tern {
namespace {

/// Returns the pieces of the committed trajectory from t_s on. `times` receives their ends in seconds after t_s, from
/// 0.
std::vector<PowerCubic> remaining_pieces(const HorizonRequest& request, std::vector<double>& times) {
  const TimedSpline& committed = request.committed;
  std::vector<PowerCubic> pieces;
  times.assign(1, 0.0);
  if (request.t_s >= committed.end()) return pieces;
  const PiecewiseCubic motion = remaining_motion(committed.spline(), committed.start, request.t_s);
  UTime t = request.t_s;
  for (const CubicPiece& piece : motion.pieces) {
    pieces.push_back(reparametrized(piece.coefficients, 0.0, piece.duration.seconds()));
    t = t + piece.duration;
    times.push_back((t - request.t_s).seconds());
  }
  return pieces;
}

bool stays_within(const std::vector<PowerCubic>& pieces, const Box& room) {
  const Box allowed = grown(room, Vec3::Constant(kBoxTolerance));
  return std::ranges::all_of(pieces,
                             [&](const PowerCubic& piece) { return allowed.contains(cubic_bounds(piece, 0.0, 1.0)); });
}

}  // namespace

std::optional<Candidate> check_committed(const Surroundings& near, PlanTools& tools) {
  const HorizonRequest& request = near.request;
  std::vector<double>& times = tools.memory.times;
  const std::vector<PowerCubic> pieces = remaining_pieces(request, times);
  const double moving_s = times.back();
  if (moving_s > near.look.followed_s) return std::nullopt;
  const bool rests = pieces.empty();
  const double look_s = rests ? near.hold.cap_of_stop(0.0) : near.hold.cap(moving_s);
  append_hold(times, kHoldStep, std::min(look_s, near.look.followed_s - moving_s));
  SeparationCache& swept =
      tools.memory.committed.assign(near.obstacles, request.body, request.t_s, times, near.committed);
  CheckReport report = check_separation(pieces, swept);
  tools.log.statistics.pairs += report.pairs;
  tools.log.statistics.count(swept);
  if (!report.ok() || !stays_within(pieces, near.free_side)) return std::nullopt;
  const Vec3 end = request.committed.control_points.rightCols<1>();
  const ClearTime clear = clear_time_at(swept, static_cast<int>(pieces.size()), end, report.pairs);
  if (rests && clear.seconds <= 0.0) return std::nullopt;
  Candidate c;
  c.outcome = PlanOutcome::KeepCommitted;
  c.assurance = near.assurance;
  c.relaxed = near.start.relaxed;
  c.trajectory = request.committed;
  c.certificate = std::move(report.certificate);
  c.hold_s = std::min(clear.seconds, near.hold.cap(moving_s));
  c.holds = lasts(c.hold_s, near.hold.required(moving_s));
  c.clear_s = moving_s + clear.seconds;
  c.contact_s = contact_time(near, c.trajectory);
  c.meets_declared = clear.blocker != nullptr && clear.blocker->is_declared_or_static();
  return c;
}

}  // namespace tern
