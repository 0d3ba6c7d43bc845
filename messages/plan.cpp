#include <cmath>

#include "core/world/track.h"
#include "core/world/voxel_map.h"
#include "messages/form.h"
#include "tern_msgs/plan_t.hpp"

namespace tern {

template <>
struct wire::Form<Plan> {
  using Message = tern_msgs::plan_t;
  static_assert(Message::MIN_CONTROL_POINTS == kMinControlPoints);
  static_assert(Message::MAX_CONTROL_POINTS == kMaxControlPoints);
  static_assert(Message::MAX_PLANES == kMaxCertificatePlanes);
  static_assert(Message::MAX_CUTS == kMaxBudgetCuts);
  static_assert(Message::NO_PLAN == static_cast<int>(PlanOutcome::NoPlan));
  static_assert(Message::AT_GOAL == static_cast<int>(PlanReason::AtGoal));
  static constexpr Layout kLayout{
      Array{&Message::control_point_count, &Message::control_points, kMinControlPoints, kMaxControlPoints},
      Array{&Message::plane_count, &Message::planes, 0, kMaxCertificatePlanes},
      Array{&Message::cut_count, &Message::cuts, 0, kMaxBudgetCuts},
  };
  static constexpr double kUnitTolerance = 1e-6;  // of a normal's length
  static constexpr double kMaxOffset = 1e7;       // m: beyond √3·kMaxCoordinate

  static void fields(auto& io, auto& m, auto& plan) {
    io.header("header", m.header, plan.header);
    io.integer("request_id", m.request_id, plan.request_id, 1, kMaxCounter);
    io.enumeration("outcome", m.outcome, plan.outcome, PlanOutcome::NoPlan);
    io.enumeration("reason", m.reason, plan.reason, PlanReason::AtGoal);
    io.time("start_us", m.start_us, plan.trajectory.start);
    io.duration("interval_us", m.interval_us, plan.trajectory.interval, kMinIntervalDuration, kMaxIntervalDuration);
    io.points("control_points", m.control_points, plan.trajectory.control_points, kMaxCoordinate);
    io.duration("hold_us", m.hold_us, plan.hold, Duration{0}, kMaxSpan);
    io.number("confidence", m.confidence, plan.confidence, 0.0, 1.0);
    io.integer("level", m.level, plan.level, 0, kLevels - 1);
    io.number("alpha_scale", m.alpha_scale, plan.alpha_scale, 0.0, 1.0);
    io.duration("sure_for_us", m.sure_for_us, plan.sure_for, Duration{0}, kMaxSpan);
    io.flag("relaxed", m.relaxed, plan.relaxed);
    io.position("local_goal", m.local_goal, plan.local_goal);
    io.number("sphere_radius", m.sphere_radius, plan.sphere_radius, 0.0, kMaxCoordinate);
    cost_fields(io, m, plan.cost);
    inputs_fields(io, m, plan.inputs);
    io.list("planes", m.planes, plan.certificate, [&io](auto& p, auto& plane) {
      io.integer("track", p.track, plane.track, -1 - kMaxVoxels, kMaxCounter);
      io.any("interval", p.interval, plane.interval);
      io.any("part", p.part, plane.part);
      io.any("parts", p.parts, plane.parts);
      io.vec3("normal", p.normal, plane.plane.n, -1.0 - kUnitTolerance, 1.0 + kUnitTolerance);
      io.number("offset", p.offset, plane.plane.d, -kMaxOffset, kMaxOffset);
    });
    io.list("cuts", m.cuts, plan.cuts, [&io](auto& c, auto& cut) {
      io.enumeration("phase", c.phase, cut.phase, Phase::Room);
      io.integer("attempt", c.attempt, cut.attempt, 0, kMaxAttempts - 1);
      io.enumeration("stage", c.stage, cut.stage, Stage::Check);
      io.counter("count", c.count, cut.count);
    });
  }

  static void cost_fields(auto& io, auto& m, auto& cost) {
    io.number("cost_distance_to_goal", m.cost_distance_to_goal, cost.distance_to_goal, 0.0, kMaxNumber);
    io.number("cost_jerk", m.cost_jerk, cost.jerk, 0.0, kMaxNumber);
    io.number("cost_attraction", m.cost_attraction, cost.attraction, -kMaxNumber, kMaxNumber);
    io.number("cost_repulsion", m.cost_repulsion, cost.repulsion, -kMaxNumber, kMaxNumber);
    io.number("cost_total", m.cost_total, cost.total, -kMaxNumber, kMaxNumber);
  }

  static void inputs_fields(auto& io, auto& m, auto& inputs) {
    io.name("request", m.request, inputs.request);
    io.name("goal", m.goal, inputs.goal);
    io.name("predictions", m.predictions, inputs.predictions);
    io.counter("prediction_set", m.prediction_set, inputs.prediction_set);
    io.integer("left_out", m.left_out, inputs.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.any("map_version", m.map_version, inputs.map_version);
    io.any("configuration_hash", m.configuration_hash, inputs.configuration_hash);
    io.any("planner_build", m.planner_build, inputs.planner_build);
    io.any("field_map_version", m.field_map_version, inputs.goal_field.map_version);
    io.counter("field_statics_epoch_us", m.field_statics_epoch_us, inputs.goal_field.statics_epoch_us);
    io.counter("field_statics_first_set", m.field_statics_first_set, inputs.goal_field.statics_first_set);
    io.any("field_statics", m.field_statics, inputs.goal_field.statics);
    io.name("field_vehicle", m.field_vehicle, inputs.goal_field.vehicle);
  }

  static void write_rest(Message& m, const Plan& plan) {
    m.from_watchdog = plan.standing.has_value();
    m.standing = plan.standing.value_or(0);
  }

  static void read_rest(FieldReader& read, const Message& m, Plan& plan) {
    const std::int64_t standing = read.named("standing").counter(m.standing);
    if (read.named("from_watchdog").flag(m.from_watchdog)) {
      plan.standing = standing;
    } else {
      read.consistent(standing == 0);
    }
    if (plan.alpha_scale < 1.0) read.consistent(plan.level == kLevels - 1 && plan.confidence == 0.0);
    if (plan.sure_for == Duration{0}) read.consistent(plan.confidence == 0.0);
    const int intervals = m.control_point_count - 3;
    for (const CertificatePlane& p : plan.certificate) {
      read.consistent(std::abs(p.plane.n.norm() - 1.0) <= kUnitTolerance);
      read.consistent(0 <= p.interval && p.interval < intervals);
      read.consistent((p.parts == 1 || p.parts == 2 || p.parts == 4) && 0 <= p.part && p.part < p.parts);
    }
  }
};

template Bytes encode(const Plan& value);
template tl::expected<Plan, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<Plan>(std::span<const std::uint8_t> bytes);

}  // namespace tern
