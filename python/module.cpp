// tern._tern: the planner, logs, campaigns and virtual flights for Python. python/tern adds the parts in Python.
#include <pybind11/stl.h>

#include "python/bindings.h"
#include "runtime/config.h"
#include "runtime/log.h"
#include "runtime/version.h"

namespace py = pybind11;

namespace tern::python {

std::vector<std::string> settings_of(const py::object& settings) {
  return py::module_::import("tern.settings").attr("setting_texts")(settings).cast<std::vector<std::string>>();
}

}  // namespace tern::python

// NOLINTNEXTLINE(readability-function-size)
PYBIND11_MODULE(_tern, m) {
  m.doc() = "Tern's planner, logs, campaigns and virtual flights. Use the package tern.";
  m.attr("build_id") = tern::build_id();
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const tern::ConfigError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const tern::python::FileError& e) {
      PyErr_SetString(PyExc_OSError, e.what());
    }
  });
  // The processes of a virtual flight log their lives; a program that hosts them has other things to say.
  tern::log::start("tern", "error");

  tern::python::bind_vehicle(m);
  tern::python::bind_world(m);
  tern::python::bind_plan(m);
  tern::python::bind_problems(m);
  tern::python::bind_log(m);
  tern::python::bind_campaign(m);
  tern::python::bind_environment(m);
}
