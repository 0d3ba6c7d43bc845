#include <cmath>

#include "core/world/track.h"
#include "core/world/voxel_map.h"
#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/plan_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::plan_t;
static_assert(Message::MIN_CONTROL_POINTS == kMinControlPoints);
static_assert(Message::MAX_CONTROL_POINTS == kMaxControlPoints);
static_assert(Message::MAX_PLANES == kMaxCertificatePlanes);
static_assert(Message::MAX_CUTS == kMaxBudgetCuts);
static_assert(Message::NO_PLAN == static_cast<int>(PlanOutcome::NoPlan));
static_assert(Message::AT_GOAL == static_cast<int>(PlanReason::AtGoal));

const wire::Layout kLayout{
    wire::Array{&Message::control_point_count, &Message::control_points, kMinControlPoints, kMaxControlPoints},
    wire::Array{&Message::plane_count, &Message::planes, 0, kMaxCertificatePlanes},
    wire::Array{&Message::cut_count, &Message::cuts, 0, kMaxBudgetCuts},
};
constexpr double kUnitTolerance = 1e-6;  // of a normal's length
constexpr double kMaxOffset = 1e7;       // m: beyond √3·kMaxCoordinate

tern_msgs::certificate_plane_t to_lcm(const CertificatePlane& plane) {
  tern_msgs::certificate_plane_t m{};
  m.track = plane.track;
  m.interval = plane.interval;
  m.part = plane.part;
  m.parts = plane.parts;
  m.normal = wire::to_lcm(plane.plane.n);
  m.offset = plane.plane.d;
  return m;
}

tern_msgs::budget_cut_t to_lcm(const BudgetCut& cut) {
  tern_msgs::budget_cut_t m{};
  m.phase = wire::to_int8(cut.phase);
  m.attempt = cut.attempt;
  m.stage = wire::to_int8(cut.stage);
  m.count = cut.count;
  return m;
}

BudgetCut read_cut(wire::FieldReader& read, const tern_msgs::budget_cut_t& m) {
  const Phase phase = read.enumeration(m.phase, Phase::Room);
  const int attempt = read.integer(m.attempt, 0, kMostAttempts - 1);
  const Stage stage = read.enumeration(m.stage, Stage::Check);
  return {phase, attempt, stage, read.counter(m.count)};
}

void put(Message& m, const PlanCost& cost) {
  m.cost_distance_to_goal = cost.distance_to_goal;
  m.cost_jerk = cost.jerk;
  m.cost_attraction = cost.attraction;
  m.cost_repulsion = cost.repulsion;
  m.cost_total = cost.total;
}

void put(Message& m, const PlanInputs& inputs) {
  m.request = wire::to_lcm(inputs.request);
  m.goal = wire::to_lcm(inputs.goal);
  m.predictions = wire::to_lcm(inputs.predictions);
  m.prediction_set = inputs.prediction_set;
  m.left_out = inputs.left_out;
  m.map_version = static_cast<std::int64_t>(inputs.map_version);
  m.configuration_hash = static_cast<std::int64_t>(inputs.configuration_hash);
  m.planner_build = static_cast<std::int64_t>(inputs.planner_build);
  m.field_map_version = static_cast<std::int64_t>(inputs.goal_field.map_version);
  m.field_statics_epoch_us = inputs.goal_field.statics_epoch_us;
  m.field_statics_first_set = inputs.goal_field.statics_first_set;
  m.field_statics = static_cast<std::int64_t>(inputs.goal_field.statics);
  m.field_vehicle = wire::to_lcm(inputs.goal_field.vehicle);
}

Message to_lcm(const Plan& plan) {
  Message m{};
  m.header = wire::to_lcm(plan.header);
  m.request_id = plan.request_id;
  m.outcome = wire::to_int8(plan.outcome);
  m.reason = wire::to_int8(plan.reason);
  m.start_us = plan.trajectory.start.us;
  m.interval_us = plan.trajectory.interval.us;
  m.hold_us = plan.hold.us;
  m.confidence = plan.confidence;
  m.level = static_cast<std::int8_t>(plan.level);
  m.alpha_scale = plan.alpha_scale;
  m.sure_for_us = plan.sure_for.us;
  m.from_watchdog = plan.standing.has_value();
  m.standing = plan.standing.value_or(0);
  m.relaxed = plan.relaxed;
  m.local_goal = wire::to_lcm(plan.local_goal);
  m.sphere_radius = plan.sphere_radius;
  put(m, plan.cost);
  put(m, plan.inputs);
  m.control_points = wire::to_lcm(plan.trajectory.control_points);
  for (const CertificatePlane& plane : plan.certificate) m.planes.push_back(to_lcm(plane));
  for (const BudgetCut& cut : plan.cuts) m.cuts.push_back(to_lcm(cut));
  return m;
}

PlanCost read_cost(wire::FieldReader& read, const Message& m) {
  const auto finite = [&](double x) { return read.number(x, -wire::kMaxNumber, wire::kMaxNumber); };
  PlanCost cost;
  cost.distance_to_goal = read.number(m.cost_distance_to_goal, 0.0, wire::kMaxNumber);
  cost.jerk = read.number(m.cost_jerk, 0.0, wire::kMaxNumber);
  cost.attraction = finite(m.cost_attraction);
  cost.repulsion = finite(m.cost_repulsion);
  cost.total = finite(m.cost_total);
  return cost;
}

PlanInputs read_inputs(wire::FieldReader& read, const Message& m) {
  PlanInputs inputs;
  inputs.request = read.name(m.request);
  inputs.goal = read.name(m.goal);
  inputs.predictions = read.name(m.predictions);
  inputs.prediction_set = read.counter(m.prediction_set);
  inputs.left_out = read.integer(m.left_out, 0, std::numeric_limits<std::int32_t>::max());
  inputs.map_version = static_cast<std::uint64_t>(m.map_version);
  inputs.configuration_hash = static_cast<std::uint64_t>(m.configuration_hash);
  inputs.planner_build = static_cast<std::uint64_t>(m.planner_build);
  inputs.goal_field.map_version = static_cast<std::uint64_t>(m.field_map_version);
  inputs.goal_field.statics_epoch_us = read.counter(m.field_statics_epoch_us);
  inputs.goal_field.statics_first_set = read.counter(m.field_statics_first_set);
  inputs.goal_field.statics = static_cast<std::uint64_t>(m.field_statics);
  inputs.goal_field.vehicle = read.name(m.field_vehicle);
  return inputs;
}

CertificatePlane read_plane(wire::FieldReader& read, const tern_msgs::certificate_plane_t& m, std::int16_t intervals) {
  CertificatePlane plane;
  plane.track = read.integer(m.track, -1 - kMaxVoxels, wire::kMaxCounter);
  plane.interval = m.interval;
  plane.part = m.part;
  plane.parts = m.parts;
  plane.plane.n = read.vec3(m.normal, -1.0 - kUnitTolerance, 1.0 + kUnitTolerance);
  plane.plane.d = read.number(m.offset, -kMaxOffset, kMaxOffset);
  read.consistent(std::abs(plane.plane.n.norm() - 1.0) <= kUnitTolerance);
  read.consistent(0 <= m.interval && m.interval < intervals);
  read.consistent((m.parts == 1 || m.parts == 2 || m.parts == 4) && 0 <= m.part && m.part < m.parts);
  return plane;
}

tl::expected<Plan, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  Plan plan;
  plan.header = read.header(m.header);
  plan.request_id = read.integer<std::int64_t>(m.request_id, 1, wire::kMaxCounter);
  plan.outcome = read.enumeration(m.outcome, PlanOutcome::NoPlan);
  plan.reason = read.enumeration(m.reason, PlanReason::AtGoal);
  plan.trajectory.start = read.time(m.start_us);
  plan.trajectory.interval = read.duration(m.interval_us, kShortestInterval, kLongestInterval);
  plan.trajectory.control_points = read.points(m.control_points, kMaxCoordinate);
  plan.hold = read.duration(m.hold_us, Duration{0}, kMaxSpan);
  plan.confidence = read.number(m.confidence, 0.0, 1.0);
  plan.level = read.integer<int>(m.level, 0, kLevels - 1);
  plan.alpha_scale = read.number(m.alpha_scale, 0.0, 1.0);
  if (plan.alpha_scale < 1.0) read.consistent(plan.level == kLevels - 1 && plan.confidence == 0.0);
  plan.sure_for = read.duration(m.sure_for_us, Duration{0}, kMaxSpan);
  if (plan.sure_for == Duration{0}) read.consistent(plan.confidence == 0.0);
  const std::int64_t standing = read.counter(m.standing);
  if (read.flag(m.from_watchdog)) {
    plan.standing = standing;
  } else {
    read.consistent(standing == 0);
  }
  plan.relaxed = read.flag(m.relaxed);
  plan.local_goal = read.position(m.local_goal);
  plan.sphere_radius = read.number(m.sphere_radius, 0.0, kMaxCoordinate);
  plan.cost = read_cost(read, m);
  plan.inputs = read_inputs(read, m);
  const auto intervals = static_cast<std::int16_t>(m.control_point_count - 3);
  plan.certificate.reserve(m.planes.size());
  for (const auto& plane : m.planes) plan.certificate.push_back(read_plane(read, plane, intervals));
  for (const auto& cut : m.cuts) plan.cuts.push_back(read_cut(read, cut));
  return read.accept(std::move(plan));
}

}  // namespace

template <>
Bytes encode(const Plan& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<Plan, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
