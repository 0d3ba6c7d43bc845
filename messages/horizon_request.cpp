#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/horizon_request_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::horizon_request_t;
static_assert(Message::MIN_CONTROL_POINTS == kMinControlPoints);
static_assert(Message::MAX_CONTROL_POINTS == kMaxControlPoints);
static_assert(Message::MAX_BODY_VERTICES == kMaxBodyVertices);

const wire::Layout kLayout{
    wire::Array{&Message::control_point_count, &Message::control_points, kMinControlPoints, kMaxControlPoints},
    wire::Array{&Message::body_vertex_count, &Message::body_vertices, 1, kMaxBodyVertices},
};

Message to_lcm(const HorizonRequest& request) {
  Message m{};
  m.header = wire::to_lcm(request.header);
  m.id = request.id;
  m.t_s_us = request.t_s.us;
  m.deadline_us = request.deadline.us;
  m.start = wire::to_lcm(request.start);
  m.v_max = wire::to_lcm(request.limits.v_max);
  m.a_max = wire::to_lcm(request.limits.a_max);
  m.j_max = wire::to_lcm(request.limits.j_max);
  m.has_dynamics = request.limits.dynamics.has_value();
  if (const auto& dynamics = request.limits.dynamics) {
    m.thrust_min = dynamics->thrust_min;
    m.thrust_max = dynamics->thrust_max;
    m.tilt_max_deg = dynamics->tilt_max_deg;
    m.body_rate_max_deg_s = dynamics->body_rate_max_deg_s;
  }
  m.body_radius = request.body.radius;
  m.flight_box_min = wire::to_lcm(request.flight_box.min());
  m.flight_box_max = wire::to_lcm(request.flight_box.max());
  m.tube = wire::to_lcm(request.tube);
  m.committed_start_us = request.committed.start.us;
  m.committed_interval_us = request.committed.interval.us;
  m.control_points = wire::to_lcm(request.committed.control_points);
  m.body_vertices = wire::to_lcm(request.body.vertices);
  return m;
}

bool agree(const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff() <= kJoinTolerance; }

/// Jerk is not compared: at a knot it has two values.
bool starts_on(const TimedSpline& committed, UTime t_s, const MotionSample& start) {
  const MotionSample there = committed.sample(t_s);
  return agree(there.p, start.p) && agree(there.v, start.v) && agree(there.a, start.a);
}

std::optional<Dynamics> read_dynamics(const Message& m, wire::FieldReader& read) {
  if (!read.flag(m.has_dynamics)) {
    for (const double x : {m.thrust_min, m.thrust_max, m.tilt_max_deg, m.body_rate_max_deg_s}) read.number(x, 0.0, 0.0);
    return std::nullopt;
  }
  const auto within = [&](double x, const Range& range) { return read.number(x, range.low, range.high); };
  return Dynamics{within(m.thrust_min, Dynamics::kThrustMin), within(m.thrust_max, Dynamics::kThrustMax),
                  within(m.tilt_max_deg, Dynamics::kTilt), within(m.body_rate_max_deg_s, Dynamics::kBodyRate)};
}

tl::expected<HorizonRequest, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  HorizonRequest request;
  request.header = read.header(m.header);
  request.id = read.integer<std::int64_t>(m.id, 1, wire::kMaxCounter);
  request.t_s = read.time(m.t_s_us);
  request.deadline = read.time(m.deadline_us);
  request.committed.start = read.time(m.committed_start_us);
  request.committed.interval = read.duration(m.committed_interval_us, kShortestInterval, kLongestInterval);
  request.committed.control_points = read.points(m.control_points, kMaxCoordinate);
  request.start = read.motion(m.start);
  request.limits.v_max = read.vec3(m.v_max, kLeastLimit, kMostSpeedLimit);
  request.limits.a_max = read.vec3(m.a_max, kLeastLimit, kMostAccelerationLimit);
  request.limits.j_max = read.vec3(m.j_max, kLeastLimit, wire::kInfinity);
  request.limits.dynamics = read_dynamics(m, read);
  request.body.radius = read.number(m.body_radius, 0.0, kMaxBodyExtent);
  request.body.vertices = read.points(m.body_vertices, kMaxBodyExtent);
  request.flight_box = Box(read.position(m.flight_box_min), read.position(m.flight_box_max));
  request.tube = read.vec3(m.tube, 0.0, kMaxBodyExtent);
  read.consistent(!request.flight_box.isEmpty());
  read.in_order(request.deadline <= request.t_s - kDeadlineLead);
  read.in_order(request.committed.start <= request.t_s);
  if (!read.ok()) return read.accept(std::move(request));
  read.consistent(request.committed.spline().ends_at_rest());
  read.consistent(starts_on(request.committed, request.t_s, request.start));
  return read.accept(std::move(request));
}

}  // namespace

template <>
Bytes encode(const HorizonRequest& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<HorizonRequest, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
