#include <cmath>

#include "messages/form.h"
#include "tern_msgs/horizon_request_t.hpp"

namespace tern {
namespace {

bool agree(const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff() <= kJoinTolerance; }

/// Compares position, velocity and acceleration. Jerk is left out, because it has two values at a knot.
bool starts_on(const TimedSpline& committed, UTime t_s, const MotionSample& start) {
  const MotionSample there = committed.sample(t_s);
  return agree(there.p, start.p) && agree(there.v, start.v) && agree(there.a, start.a);
}

}  // namespace

template <>
struct wire::Form<HorizonRequest> {
  using Message = tern_msgs::horizon_request_t;
  static_assert(Message::MIN_CONTROL_POINTS == kMinControlPoints);
  static_assert(Message::MAX_CONTROL_POINTS == kMaxControlPoints);
  static_assert(Message::MAX_BODY_VERTICES == kMaxBodyVertices);
  static constexpr Layout kLayout{
      Array{&Message::control_point_count, &Message::control_points, kMinControlPoints, kMaxControlPoints},
      Array{&Message::body_vertex_count, &Message::body_vertices, 1, kMaxBodyVertices},
  };

  static void fields(auto& io, auto& m, auto& request) {
    io.header("header", m.header, request.header);
    io.integer("id", m.id, request.id, 1, kMaxCounter);
    io.time("t_s_us", m.t_s_us, request.t_s);
    io.time("deadline_us", m.deadline_us, request.deadline);
    io.time("committed_start_us", m.committed_start_us, request.committed.start);
    io.duration("committed_interval_us", m.committed_interval_us, request.committed.interval, kMinIntervalDuration,
                kMaxIntervalDuration);
    io.points("control_points", m.control_points, request.committed.control_points, kMaxCoordinate);
    io.motion("start", m.start, request.start);
    io.vec3("v_max", m.v_max, request.limits.v_max, kMinLimit, kMaxSpeedLimit);
    io.vec3("a_max", m.a_max, request.limits.a_max, kMinLimit, kMaxAccelerationLimit);
    io.vec3("j_max", m.j_max, request.limits.j_max, kMinLimit, kInfinity);
    io.number("body_radius", m.body_radius, request.body.radius, 0.0, kMaxBodyExtent);
    io.points("body_vertices", m.body_vertices, request.body.vertices, kMaxBodyExtent);
    io.position("flight_box_min", m.flight_box_min, request.flight_box.min());
    io.position("flight_box_max", m.flight_box_max, request.flight_box.max());
    io.vec3("tube", m.tube, request.tube, 0.0, kMaxBodyExtent);
  }

  static void dynamics_fields(auto& io, auto& m, auto& dynamics) {
    const auto within = [&io](const char* name, auto& field, auto& x, const Range& range) {
      io.number(name, field, x, range.low, range.high);
    };
    within("thrust_min", m.thrust_min, dynamics.thrust_min, Dynamics::kThrustMin);
    within("thrust_max", m.thrust_max, dynamics.thrust_max, Dynamics::kThrustMax);
    within("tilt_max_deg", m.tilt_max_deg, dynamics.tilt_max_deg, Dynamics::kTilt);
    within("body_rate_max_deg_s", m.body_rate_max_deg_s, dynamics.body_rate_max_deg_s, Dynamics::kBodyRate);
  }

  static void write_rest(Message& m, const HorizonRequest& request) {
    FieldWriter write;
    write.flag("has_dynamics", m.has_dynamics, request.limits.dynamics.has_value());
    if (request.limits.dynamics) dynamics_fields(write, m, *request.limits.dynamics);
  }

  static void read_rest(FieldReader& read, const Message& m, HorizonRequest& request) {
    if (read.flag(m.has_dynamics)) {
      dynamics_fields(read, m, request.limits.dynamics.emplace());
    } else {
      for (const double x : {m.thrust_min, m.thrust_max, m.tilt_max_deg, m.body_rate_max_deg_s}) {
        read.number(x, 0.0, 0.0);
        read.consistent(!std::signbit(x));  // −0 is refused: no dynamics has one form
      }
    }
    read.consistent(!request.flight_box.isEmpty());
    read.in_order(request.deadline <= request.t_s - kDeadlineLead);
    read.in_order(request.committed.start <= request.t_s);
    if (!read.ok()) return;
    read.consistent(request.committed.spline().ends_at_rest());
    read.consistent(starts_on(request.committed, request.t_s, request.start));
  }
};

template Bytes encode(const HorizonRequest& value);
template tl::expected<HorizonRequest, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<HorizonRequest>(std::span<const std::uint8_t> bytes);

}  // namespace tern
