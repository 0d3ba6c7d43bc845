#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>

#include "core/world/names.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/virtual_flight.h"

namespace tern::python {
namespace {

py::dict measures_of(const VirtualFlight& flight) {
  py::dict measures;
  const auto result = flight.result();
  if (!result) return measures;
  measures["flight_time_s"] = result->flight_time_s;
  measures["path_length_m"] = result->path_length_m;
  measures["top_speed_mps"] = result->top_speed_mps;
  measures["min_clearance_m"] = result->min_clearance_m;
  measures["min_map_clearance_m"] = result->min_map_clearance_m;
  measures["jerk_integral"] = result->jerk_integral;
  measures["stops"] = result->stops;
  measures["limit_violations"] = result->limit_violations;
  py::dict exposure;
  for (const Exposure& e : result->exposure) exposure[py::str(e.region)] = py::make_tuple(e.seconds, e.metres);
  measures["exposure"] = exposure;
  return measures;
}

std::unique_ptr<VirtualFlight> flight_of(const std::filesystem::path& scenario, const py::object& settings) {
  const std::vector<std::string> texts = settings_of(settings);
  const py::gil_scoped_release release;
  return std::make_unique<VirtualFlight>(scenario.string(), texts);
}

}  // namespace

void bind_environment(py::module_& m) {
  using namespace py::literals;
  py::class_<VirtualFlight>(m, "Flight",
                            "A flight on virtual time whose plans the caller makes: simulator, executor, predictor and "
                            "mapper of a scenario. It stops at each request.")
      .def(py::init(&flight_of), "scenario"_a, "settings"_a = py::dict(),
           "scenario: path of a file. settings: values by key, such as {'seed': 7}.")
      .def("advance", &VirtualFlight::advance, py::call_guard<py::gil_scoped_release>(),
           "Runs until a request is open (True) or the flight has ended (False). A request that is open stays without "
           "an "
           "answer.")
      .def_property_readonly(
          "request", [](const VirtualFlight& f) { return f.request(); }, "The open request.")
      .def_property_readonly(
          "weights",
          [](const VirtualFlight& f) { return py::make_tuple(f.weights().attractive, f.weights().repulsive); },
          "The scenario's weights of attractive and of repulsive regions.")
      .def(
          "world",
          [](VirtualFlight& f, double attractive, double repulsive) {
            const py::gil_scoped_release release;
            return f.world({attractive, repulsive});
          },
          "attractive"_a, "repulsive"_a, "The world of the open request, with these weights of regions (>= 0).")
      .def(
          "answer", [](VirtualFlight& f, const Answer& answer) { f.answer(answer.plan); }, "answer"_a,
          "Sends the answer to the open request, 15 ms of virtual time after the request.")
      .def_property_readonly(
          "now_us", [](const VirtualFlight& f) { return f.now().us; }, "Virtual time.")
      .def_property_readonly(
          "outcome",
          [](const VirtualFlight& f) -> py::object {
            if (!f.ending()) return py::none();
            return py::str(to_string(f.ending()->outcome));
          },
          "reached, collision, timeout or failed; None while it flies.")
      .def_property_readonly(
          "detail", [](const VirtualFlight& f) { return f.ending() ? f.ending()->detail : ""; },
          "The outcome in words.")
      .def_property_readonly("measures", &measures_of, "The referee's measures; empty while it flies.");
}

}  // namespace tern::python
