#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/planning.h"
#include "tools/replay/recorded_problems.h"
#include "tools/replay/replan.h"

namespace tern::python {
namespace {

/// An answer of a log with the inputs that it names.
struct Problem {
  std::int64_t received_us = 0;
  std::string missing;  ///< the inputs that the log lacks; empty: none
  PlanProblem inputs;
  Plan recorded;

  [[nodiscard]] const PlanProblem& known() const {
    if (!missing.empty()) throw py::value_error("the log lacks " + missing);
    return inputs;
  }
  [[nodiscard]] Answer plan_again() const {
    const PlanProblem& problem = known();
    const py::gil_scoped_release release;
    Replanned again = replan(problem, recorded);
    return {std::move(again.plan), again.statistics};
  }
};

template <class T>
T value_or_file_error(Result<T> result) {
  if (!result) throw FileError(result.error().message);
  return std::move(*result);
}

std::vector<Problem> problems(const std::string& log, const ReplayOptions& options) {
  const py::gil_scoped_release release;
  options.other.check();
  const RecordedInputs inputs = value_or_file_error(read_recorded_inputs(log, options.suffix));
  std::vector<Problem> problems(inputs.plans.size());
  std::vector<bool> visited(inputs.plans.size());
  value_or_file_error(visit_answers(log, inputs, options, [&](std::size_t index, WorldRebuilder& world) {
    Problem& problem = problems[index];
    const RecordedPlan& recorded = inputs.plans[index];
    visited[index] = true;
    problem.received_us = recorded.received_us;
    problem.recorded = recorded.plan;
    auto rebuilt = world.problem_of(recorded.plan);
    if (rebuilt) problem.inputs = std::move(*rebuilt);
    if (!rebuilt) problem.missing = rebuilt.error().message;
  }));
  std::vector<Problem> chosen;
  for (std::size_t k = 0; k < problems.size(); ++k) {
    if (visited[k]) chosen.push_back(std::move(problems[k]));
  }
  return chosen;
}

}  // namespace

void bind_problems(py::module_& m) {
  using namespace py::literals;
  py::class_<Problem>(m, "Problem", "A recorded answer with the inputs that it names.")
      .def_property_readonly(
          "received_us", [](const Problem& p) { return p.received_us; },
          "When the logger received the answer, us since the Unix epoch.")
      .def_property_readonly(
          "missing", [](const Problem& p) { return p.missing; },
          "The inputs that the log lacks; '' if there are none. Without them request and world "
          "raise ValueError.")
      .def_property_readonly("request", [](const Problem& p) { return p.known().request; })
      .def_property_readonly("world",
                             [](const Problem& p) {
                               const PlanProblem& inputs = p.known();
                               return PreparedWorld(inputs.world, inputs.config, inputs.request.start.p);
                             })
      .def_property_readonly(
          "recorded",
          [](const Problem& p) {
            return Answer{p.recorded, std::nullopt};
          },
          "The answer of the flight.")
      .def("plan_again", &Problem::plan_again,
           "Plans with the counts that the recorded answer spent, as tern-replay does. Header and the names that the "
           "planner's process adds are copied, so equal answers have equal to_bytes().");

  m.def(
      "problems",
      [](const std::filesystem::path& log, std::optional<std::int64_t> request, std::optional<double> from_s,
         std::optional<double> to_s, const std::string& suffix, const py::object& settings) {
        ReplayOptions options;
        options.request = request;
        options.from_s = from_s;
        options.to_s = to_s;
        options.suffix = suffix;
        options.other.settings = settings_of(settings);
        return problems(log.string(), options);
      },
      "log"_a, py::kw_only(), "request"_a = py::none(), "from_s"_a = py::none(), "to_s"_a = py::none(), "suffix"_a = "",
      "settings"_a = py::dict(),
      "The answers of a log with their inputs, in the log's order. log: a file, a flight's folder or a text fixture. "
      "request: only answers to the request with this id. from_s, to_s: only answers between these times, s since the "
      "log's first message. suffix: of the vehicle's channels. settings: other settings of the planner, "
      "such as {'planner.search.samples_xy': 5}. Raises OSError if the log cannot be read.");
}

}  // namespace tern::python
