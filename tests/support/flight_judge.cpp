#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/geometry/box.h"
#include "core/world/body.h"
#include "core/world/body_distance.h"
#include "simulator/worlds/world.h"
#include "tests/support/legal_scenario.h"

namespace tern::testing {
namespace {

/// Cells of a grid along its longest side.
constexpr int kCells = 48;

/// Whether the centre gets from start to goal when every standing box is grown by the body's box and by
/// `slack`. A breadth-first search over cubes: coarse, slow, and knows nothing of the planner's.
bool way_exists(const Scenario& scenario, const std::vector<Box>& boxes, double slack_cells) {
  const UavSpec& uav = scenario.uav;
  Box all(uav.start.cwiseMin(uav.goal), uav.start.cwiseMax(uav.goal));
  for (const Box& box : boxes) all.extend(box);
  const Box body = body_box(uav.body);
  all = grown(all, body.sizes() + Vec3::Constant(1.0)).intersection(places_within(uav.flight_box, body));
  const double side = std::max(1e-3, all.sizes().maxCoeff() / kCells);
  const double slack = slack_cells * side;
  const Eigen::Vector3i size = (all.sizes() / side).array().ceil().cast<int>().max(1);
  const auto cell_of = [&](const Vec3& p) -> Eigen::Vector3i {
    return Eigen::Vector3i(((p - all.min()) / side).array().floor().cast<int>())
        .cwiseMax(0)
        .cwiseMin(size.array().matrix() - Eigen::Vector3i::Ones());
  };
  const auto index = [&](const Eigen::Vector3i& c) {
    return static_cast<std::size_t>(c.x() + size.x() * (c.y() + size.y() * c.z()));
  };
  const Eigen::Vector3i from = cell_of(uav.start);
  const Eigen::Vector3i to = cell_of(uav.goal);
  const auto is_free = [&](const Eigen::Vector3i& c) {
    if (c == from || c == to) return true;
    const Vec3 p = all.min() + side * (c.cast<double>() + Vec3::Constant(0.5));
    return std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) {
      const Box solid = grown(places_at(box, body), Vec3::Constant(slack));
      return !solid.isEmpty() && solid.contains(p);
    });
  };
  std::vector<bool> seen(static_cast<std::size_t>(size.prod()), false);
  std::vector<Eigen::Vector3i> open{from};
  seen[index(from)] = true;
  while (!open.empty()) {
    const Eigen::Vector3i c = open.back();
    open.pop_back();
    if (c == to) return true;
    for (int k = 0; k < 6; ++k) {
      Eigen::Vector3i next = c;
      next[k / 2] += k % 2 == 0 ? 1 : -1;
      if ((next.array() < 0).any() || (next.array() >= size.array()).any() || seen[index(next)]) continue;
      seen[index(next)] = true;
      if (is_free(next)) open.push_back(next);
    }
  }
  return false;
}

/// Room that the hulls of small steps need between a moving obstacle and the vehicle, m.
constexpr double kNear = 1.0;

/// Returns true if a moving obstacle comes near the vehicle's last position, or near the rest of its straight path. The
/// last seconds before the end and the next few are examined.
bool mover_holds_up(const Scenario& scenario, const World& world, const Vec3& at, double end_s) {
  const Vec3 half = scenario.uav.body.half_extents();
  const Vec3 rest = scenario.uav.goal - at;
  for (const WorldObstacle& o : world.obstacles) {
    if (!o.moves()) continue;
    // Beyond its last piece, a predicted box grows at the top speed.
    const double reach = kNear + half.norm() + 4.0 * o.bounds().speed.maxCoeff();
    for (double t = std::max(0.0, end_s - 30.0); t <= end_s + 5.0; t += 0.1) {
      const Vec3 c = o.at(t).p;
      const double along =
          rest.squaredNorm() > 0.0 ? std::clamp((c - at).dot(rest) / rest.squaredNorm(), 0.0, 1.0) : 0.0;
      if (distance_to_box(at + along * rest, c, o.half_extents()) < reach) return true;
    }
  }
  return false;
}

std::optional<std::string> fault_of_exchange(const VirtualFlight& flight) {
  const ExecutorCounters& counters = flight.executor;
  if (!flight.end.empty()) return flight.end;
  if (counters.refused() > 0) return fmt::format("{} plans refused by the executor", counters.refused());
  if (counters.unanswered > 0) return fmt::format("{} requests unanswered", counters.unanswered);
  if (flight.result.limit_violations > 0) return fmt::format("{} limits broken", flight.result.limit_violations);
  return std::nullopt;
}

/// Motions are declared every 0.2 s, predicted every 0.05 s.
constexpr double kUntilPredictedS = 0.25;

/// Whether the obstacle that was touched came into being too late for the predictions of the last plan.
bool is_newcomer(const World& world, const std::string& detail, double asked_s) {
  return std::any_of(world.obstacles.begin(), world.obstacles.end(), [&](const WorldObstacle& o) {
    return o.first_s() > asked_s - kUntilPredictedS && detail.starts_with(fmt::format("touched obstacle {} ", o.id()));
  });
}

}  // namespace

void PromiseWatch::on_request(const HorizonRequest& request) {
  if (!world_zero) world_zero = request.header.utime;
  at = request.start.p;
  asked_at = request.header.utime;
}

void PromiseWatch::on_plan(const Plan& plan) {
  last_reason = plan.reason;
  if (plan.outcome != PlanOutcome::NoPlan) promised_until = plan.trajectory.end() + plan.hold;
}

const char* to_string(FlightReason reason) {
  constexpr const char* kNames[] = {"reached", "start in obstacle",     "way blocked",      "way narrow",
                                    "held up", "hit after its promise", "hit by a newcomer"};
  return kNames[static_cast<int>(reason)];
}

FlightJudgement judge(const LegalScenario& legal, const VirtualFlight& flight, const PromiseWatch& watch) {
  const Scenario& scenario = legal.scenario;
  const FlightResult& result = flight.result;
  if (const auto fault = fault_of_exchange(flight)) return {FlightReason::Reached, *fault};
  if (result.outcome == FlightOutcome::Reached) return {};
  if (result.outcome == FlightOutcome::Failed) return {FlightReason::Reached, "failed: " + result.detail};
  const World world = make_world(scenario, "").value();
  const BodyDistance distance(scenario.uav.body);
  for (const WorldObstacle& o : world.obstacles) {
    if (!o.present(0.0) || distance(scenario.uav.start - o.at(0.0).p, o.half_extents()) > 1e-6) continue;
    return {FlightReason::StartInObstacle, ""};
  }
  const bool movers =
      std::any_of(world.obstacles.begin(), world.obstacles.end(), [](const auto& o) { return o.moves(); });
  if (result.outcome == FlightOutcome::Collision) {
    if (is_newcomer(world, result.detail, (watch.asked_at - *watch.world_zero).seconds()))
      return {FlightReason::HitByNewcomer, ""};
    const UTime at = *watch.world_zero + Duration::from_seconds(result.flight_time_s);
    if (at <= watch.promised_until)
      return {FlightReason::HitAfterPromise, "touched within a promise: " + result.detail};
    return {FlightReason::HitAfterPromise, movers ? "" : "touched what stands: " + result.detail};
  }
  const std::vector<Box> boxes = static_boxes(world);
  const Box at_goal = body_box(scenario.uav.body).translated(scenario.uav.goal);
  const bool goal_taken =
      std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.intersects(at_goal); });
  if (goal_taken && watch.last_reason == PlanReason::GoalBlocked) return {FlightReason::WayBlocked, ""};
  if (!way_exists(scenario, boxes, -1.0)) {
    const bool said = watch.last_reason == PlanReason::GoalBlocked;
    return {FlightReason::WayBlocked, said ? "" : "no way, and the planner did not say so"};
  }
  if (!way_exists(scenario, boxes, 1.0)) return {FlightReason::WayNarrow, ""};
  if (watch.last_reason == PlanReason::GoalBlocked)
    return {FlightReason::WayBlocked, "said blocked, but there is a way"};
  if (movers && mover_holds_up(scenario, world, watch.at, result.flight_time_s)) return {FlightReason::HeldUp, ""};
  return {FlightReason::HeldUp, "not reached: " + result.detail};
}

}  // namespace tern::testing
