#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geometry/box.h"
#include "executor/commanded_motion.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/planning.h"

namespace tern::python {
namespace {

Body body_of(const py::object& radius, const py::object& half_extents, const py::object& vertices) {
  const int given = !radius.is_none() + !half_extents.is_none() + !vertices.is_none();
  if (given > 1) throw py::value_error("vehicle: give one of radius, half_extents, vertices");
  Body body;
  if (!radius.is_none()) body.radius = number_of(radius, "radius");
  if (!half_extents.is_none()) {
    body.vertices = box_corners(box_around(Vec3::Zero(), vec3_of(half_extents, "half_extents")));
  }
  if (!vertices.is_none()) body.vertices = points_of(vertices, "vertices");
  if (!half_extents.is_none() || !vertices.is_none()) body.radius = 0.0;
  return body;
}

Vehicle vehicle_of(const py::object& v_max, const py::object& a_max, const py::object& j_max, const py::object& radius,
                   const py::object& half_extents, const py::object& vertices, const py::object& tube,
                   const py::object& flight_box) {
  Vehicle vehicle;
  vehicle.limits.v_max = vec3_or_number(v_max, "v_max");
  vehicle.limits.a_max = vec3_or_number(a_max, "a_max");
  vehicle.limits.j_max = vec3_or_number(j_max, "j_max");
  vehicle.body = body_of(radius, half_extents, vertices);
  vehicle.tube = vec3_or_number(tube, "tube");
  if (!flight_box.is_none()) vehicle.flight_box = box_of(flight_box, "flight_box");
  TimedSpline rest;  // the rules of a vehicle are those of a request
  rest.start = UTime{1'000'000};
  rest.control_points.setZero();
  (void)request_of(vehicle, rest, rest.start, 1);
  return vehicle;
}

TimedSpline trajectory_of(const py::object& control_points, std::int64_t interval_us, std::int64_t start_us) {
  TimedSpline trajectory;
  trajectory.start = UTime{start_us};
  trajectory.interval = Duration{interval_us};
  trajectory.control_points = points_of(control_points, "control_points");
  const auto points = trajectory.control_points.cols();
  if (points < kMinControlPoints || points > kMaxControlPoints) {
    throw py::value_error(
        fmt::format("control_points: {} rows, not {} to {}", points, kMinControlPoints, kMaxControlPoints));
  }
  if (trajectory.interval < kMinIntervalDuration || trajectory.interval > kMaxIntervalDuration) {
    throw py::value_error(
        fmt::format("interval_us: {}, not {} to {}", interval_us, kMinIntervalDuration.us, kMaxIntervalDuration.us));
  }
  return trajectory;
}

/// Returns (p, v, a, j): four arrays (3,) for a time, (n, 3) for n of them.
py::tuple sample(const TimedSpline& trajectory, const py::object& times_us) {
  // Integers of numpy have an index as Python's own have; so has an array of one integer.
  const bool single = PyIndex_Check(times_us.ptr()) != 0 && !py::isinstance<py::array>(times_us);
  const std::vector<std::int64_t> times =
      single ? std::vector{py::int_(times_us).cast<std::int64_t>()} : integers_of(times_us, "times_us");
  const auto n = static_cast<py::ssize_t>(times.size());
  Points p(3, n), v(3, n), a(3, n), j(3, n);
  const ClampedSpline spline = trajectory.spline();
  for (py::ssize_t k = 0; k < n; ++k) {
    const std::int64_t us = times[static_cast<std::size_t>(k)];
    if (us < trajectory.start.us) {
      throw py::value_error(fmt::format("times_us: {} is before the start, {}", us, trajectory.start.us));
    }
    const MotionSample s = spline.sample((UTime{us} - trajectory.start).seconds());
    p.col(k) = s.p, v.col(k) = s.v, a.col(k) = s.a, j.col(k) = s.j;
  }
  if (!single) return py::make_tuple(array_of(p), array_of(v), array_of(a), array_of(j));
  const auto only = [](const Points& points) { return array_of(Vec3(points.col(0))); };
  return py::make_tuple(only(p), only(v), only(a), only(j));
}

TimedSpline at_rest_from(const py::object& position, std::int64_t start_us) {
  TimedSpline rest;
  rest.start = UTime{start_us};
  rest.control_points = vec3_of(position, "position").replicate(1, kMinControlPoints);
  return rest;
}

TimedSpline braking(const Vehicle& vehicle, const py::object& position, const py::object& velocity,
                    const py::object& acceleration, std::int64_t start_us) {
  MotionSample from;
  from.p = vec3_of(position, "position");
  from.v = vec3_of(velocity, "velocity");
  from.a = vec3_of(acceleration, "acceleration");
  return braking_trajectory(from, UTime{start_us}, vehicle.limits);
}

void bind_trajectory(py::module_& m) {
  using namespace py::literals;
  py::class_<TimedSpline>(m, "Trajectory",
                          "A clamped uniform cubic B-spline in W. After its end the vehicle rests at its last point.")
      .def(py::init(&trajectory_of), "control_points"_a, "interval_us"_a, "start_us"_a,
           "control_points: (J + 3, 3), m, J from 4 on. interval_us: length of one of the J intervals. start_us: when "
           "it starts.")
      .def_static("at_rest", &at_rest_from, "position"_a, "start_us"_a,
                  "The trajectory that stays at a position (W, m).")
      .def_static("braking", &braking, "vehicle"_a, "position"_a, "velocity"_a, "acceleration"_a, "start_us"_a,
                  "The trajectory that leaves a state (W; m, m/s, m/s^2) and comes to rest soonest within the "
                  "vehicle's limits. If the state exceeds them, it exceeds them least.")
      .def_property_readonly(
          "control_points", [](const TimedSpline& t) { return array_of(t.control_points); }, "(J + 3, 3), W, m.")
      .def_property_readonly("interval_us", [](const TimedSpline& t) { return t.interval.us; })
      .def_property_readonly("start_us", [](const TimedSpline& t) { return t.start.us; })
      .def_property_readonly("end_us", [](const TimedSpline& t) { return t.end().us; })
      .def("sample", &sample, "times_us"_a,
           "Position, velocity, acceleration and jerk (W; m, m/s, m/s^2, m/s^3) at a time or at n times: four arrays "
           "(3,) or (n, 3). Times are integers, none before start_us.");
}

void bind_request(py::module_& m) {
  using namespace py::literals;
  py::class_<HorizonRequest>(m, "Request",
                             "Asks for a plan that leaves the committed trajectory at t_s_us: HORIZON_REQUEST.")
      .def(py::init([](const Vehicle& vehicle, const TimedSpline& committed, std::int64_t t_s_us, std::int64_t id) {
             return request_of(vehicle, committed, UTime{t_s_us}, id);
           }),
           "vehicle"_a, "committed"_a, "t_s_us"_a, "id"_a = 1,
           "committed: the trajectory that the vehicle flies at t_s_us; it ends at rest.")
      .def_property_readonly("id", [](const HorizonRequest& r) { return r.id; })
      .def_property_readonly(
          "t_s_us", [](const HorizonRequest& r) { return r.t_s.us; }, "Start of the plan, by the vehicle's clock.")
      .def_property_readonly("deadline_us", [](const HorizonRequest& r) { return r.deadline.us; })
      .def_property_readonly("committed", [](const HorizonRequest& r) { return r.committed; })
      .def_property_readonly("vehicle",
                             [](const HorizonRequest& r) {
                               return Vehicle{r.limits, r.body, r.flight_box, r.tube};
                             })
      .def_property_readonly(
          "position", [](const HorizonRequest& r) { return array_of(r.start.p); }, "At t_s, W, m.")
      .def_property_readonly(
          "velocity", [](const HorizonRequest& r) { return array_of(r.start.v); }, "At t_s, W, m/s.")
      .def_property_readonly(
          "acceleration", [](const HorizonRequest& r) { return array_of(r.start.a); }, "At t_s, W, m/s^2.")
      .def(
          "to_bytes",
          [](const HorizonRequest& r) {
            const Bytes bytes = encode(r);
            return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
          },
          "The message HORIZON_REQUEST.");
}

}  // namespace

void bind_vehicle(py::module_& m) {
  using namespace py::literals;
  py::class_<Vehicle>(m, "Vehicle", "The limits and the body of a vehicle, and the box in which it flies.")
      .def(py::init(&vehicle_of), "v_max"_a = 6.0, "a_max"_a = py::make_tuple(20.0, 20.0, 10.0),
           "j_max"_a = std::numeric_limits<double>::infinity(), py::kw_only(), "radius"_a = py::none(),
           "half_extents"_a = py::none(), "vertices"_a = py::none(), "tube"_a = 0.0, "flight_box"_a = py::none(),
           "v_max, a_max, j_max: the largest magnitudes per axis of W, three numbers or one for all (m/s, m/s^2, "
           "m/s^3; j_max may be inf). radius (default 0.1), half_extents or vertices (n, 3): a ball, a box or the "
           "convex hull of points about the position, m; it must contain all rotations of the vehicle. tube: per axis, "
           "how far the vehicle may be from its setpoints, m. flight_box (2, 3): the body stays inside, W, m.")
      .def_property_readonly(
          "v_max", [](const Vehicle& v) { return array_of(v.limits.v_max); }, "m/s")
      .def_property_readonly(
          "a_max", [](const Vehicle& v) { return array_of(v.limits.a_max); }, "m/s^2")
      .def_property_readonly(
          "j_max", [](const Vehicle& v) { return array_of(v.limits.j_max); }, "m/s^3")
      .def_property_readonly(
          "radius", [](const Vehicle& v) { return v.body.radius; }, "m")
      .def_property_readonly(
          "vertices", [](const Vehicle& v) { return array_of(v.body.vertices); }, "(n, 3), m")
      .def_property_readonly(
          "tube", [](const Vehicle& v) { return array_of(v.tube); }, "m")
      .def_property_readonly(
          "flight_box", [](const Vehicle& v) { return array_of(v.flight_box); }, "(2, 3), W, m");
  bind_trajectory(m);
  bind_request(m);
}

}  // namespace tern::python
