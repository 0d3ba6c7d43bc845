// The parts of the module tern._tern. Each function adds its classes and functions to the module.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace tern::python {

/// A file that cannot be read or written; OSError in Python.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns settings as `--set` takes them: {"planner.search.samples_xy": 5} gives "planner.search.samples_xy=5".
std::vector<std::string> settings_of(const pybind11::object& settings);

void bind_vehicle(pybind11::module_& m);      ///< Vehicle, Trajectory, Request
void bind_world(pybind11::module_& m);        ///< Track, VoxelMap, Config, World
void bind_plan(pybind11::module_& m);         ///< Answer, plan
void bind_problems(pybind11::module_& m);     ///< Problem, problems
void bind_log(pybind11::module_& m);          ///< read_tables
void bind_campaign(pybind11::module_& m);     ///< fly_one, run_campaign
void bind_environment(pybind11::module_& m);  ///< Flight

}  // namespace tern::python
