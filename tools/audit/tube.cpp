// Whether the vehicle was where it was promised to be: within the tube about its setpoints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/audit/audit.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

/// Setpoints come at 100 Hz. After a longer gap the last one does not apply.
constexpr Duration kSetpointHole{25'000};
/// VEHICLE_STATUS comes at 10 Hz. In a longer gap the vehicle's process was delayed and flew the setpoints it had.
constexpr Duration kStatusHole{250'000};
/// A setpoint and the vehicle may both be off the committed trajectory by kJoinTolerance.
constexpr double kFollowed = 2.0 * kJoinTolerance;
/// If the next setpoint is missing, jerk may have changed by 100 m/s³ since the last one; effect on the position, m.
constexpr double kUntold = 1e-3;
constexpr char kAxes[] = {'x', 'y', 'z'};

/// Returns the commanded position at `t`: the cubic that the setpoint starts.
Vec3 commanded(const UavState& setpoint, UTime t) {
  const double s = (t - setpoint.at).seconds();
  const MotionSample& m = setpoint.motion;
  return m.p + s * (m.v + s * (0.5 * m.a + s / 6.0 * m.j));
}

/// Returns the requests that were answered by a plan or by KeepCommitted, sorted by t_s: their tubes apply from then
/// on.
std::vector<HorizonRequest> promises(const FlightRecord& record) {
  std::map<MessageName, PlanOutcome> answers;  ///< the first answer counts
  for (const Plan& plan : record.plans) answers.emplace(plan.inputs.request, plan.outcome);
  std::vector<HorizonRequest> all;
  for (const HorizonRequest& request : record.requests) {
    const auto answer = answers.find(request.header.name);
    if (answer != answers.end() && answer->second != PlanOutcome::NoPlan) all.push_back(request);
  }
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.t_s < b.t_s; });
  return all;
}

/// Returns the request in force at `t`; nullptr before the first one.
const HorizonRequest* in_force(const std::vector<HorizonRequest>& requests, UTime t) {
  const auto later = std::ranges::upper_bound(requests, t, {}, &HorizonRequest::t_s);
  return later == requests.begin() ? nullptr : &*std::prev(later);
}

/// Returns true if the vehicle was following before and after `t`. Without VEHICLE_STATUS in the log it was.
bool followed(const std::vector<VehicleStatus>& statuses, UTime t) {
  if (statuses.empty()) return true;
  const auto after = std::ranges::upper_bound(statuses, t, {}, &VehicleStatus::at);
  if (after == statuses.begin()) return false;
  const VehicleStatus& before = *std::prev(after);
  if (!before.following) return false;
  return after == statuses.end() ? t - before.at <= kStatusHole : after->at - before.at <= kStatusHole;
}

struct TrackingExtremes {
  double error_m = 0.0;
  double margin_m = INFINITY;
  Vec3 tube = Vec3::Zero();
  double squares = 0.0;
};

}  // namespace

Check check_tube(const FlightRecord& record, Audit& audit) {
  Check check{.name = "tube", .claim = "the vehicle stayed within the promised tube about its setpoints"};
  const std::vector<HorizonRequest> requests = promises(record);
  const Window window = judged_window(record);
  TrackingExtremes worst;
  // A vehicle that estimates its pose promises its tube as it believes to fly; how far off it is, is another measure.
  for (const UavState& state : record.odometry.empty() ? record.states : record.estimates) {
    if (!window.contains(state.at)) continue;
    const HorizonRequest* request = in_force(requests, state.at);
    if (request == nullptr) continue;
    if (!followed(record.statuses, state.at)) {
      ++check.unchecked["states while the vehicle was not following, or its process was delayed"];
      continue;
    }
    const auto after = std::ranges::upper_bound(record.setpoints, state.at, {}, &UavState::at);
    if (after == record.setpoints.begin() || state.at - std::prev(after)->at > kSetpointHole) {
      ++check.unchecked["states without a setpoint in the 25 ms before"];
      continue;
    }
    ++check.checked;
    const Vec3 off = (state.motion.p - commanded(*std::prev(after), state.at)).cwiseAbs();
    const Vec3 margin = request->tube - off;
    int axis = 0;
    worst.margin_m = std::min(worst.margin_m, margin.minCoeff(&axis));
    audit.tube.push_back({state.at, off[axis], request->tube[axis]});
    worst.error_m = std::max(worst.error_m, off.norm());
    worst.squares += off.squaredNorm();
    worst.tube = worst.tube.cwiseMax(request->tube);
    const bool is_told = after != record.setpoints.end() && after->at - std::prev(after)->at <= kSetpointHole;
    if (margin[axis] >= -(is_told ? kFollowed : kUntold)) continue;
    check.fail({state.at,
                fmt::format("{:.3g} m off its setpoint along {}, beyond {:.3g} m", off[axis], kAxes[axis],
                            request->tube[axis]),
                request->id});
  }
  if (check.checked == 0) return check;
  const double rmse = std::sqrt(worst.squares / static_cast<double>(check.checked));
  const bool inside = worst.margin_m >= -kFollowed;  ///< up to the tolerance of following
  check.summary = fmt::format("at most {:.3g} m off its setpoints (RMSE {:.3g} m), {:.3g} m {} the tube of {:.3g} m{}",
                              worst.error_m, rmse, inside ? std::max(worst.margin_m, 0.0) : -worst.margin_m,
                              inside ? "inside" : "beyond", worst.tube.maxCoeff(),
                              inside ? "" : "; 1 mm is allowed where a setpoint is missing");
  check.measures = {{"tracking_error_m", worst.error_m},
                    {"tracking_rmse_m", rmse},
                    {"tube_margin_m", worst.margin_m},
                    {"tube_m", worst.tube.maxCoeff()}};
  return check;
}

}  // namespace tern::audit
