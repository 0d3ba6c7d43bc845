#include <fmt/format.h>
#include <pybind11/stl.h>

#include <tuple>
#include <utility>

#include "core/world/names.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/planning.h"

namespace tern::python {
namespace {

/// Phase, attempt, stage, count: where a budget ended a loop.
using CutTuple = std::tuple<std::string, std::int32_t, std::string, std::int64_t>;

std::vector<CutTuple> cuts_of(const Plan& plan) {
  std::vector<CutTuple> cuts;
  for (const BudgetCut& cut : plan.cuts) {
    cuts.emplace_back(to_string(cut.phase), cut.attempt, to_string(cut.stage), cut.count);
  }
  return cuts;
}

std::vector<BudgetCut> cuts_of(const std::vector<CutTuple>& tuples) {
  std::vector<BudgetCut> cuts;
  for (const auto& [phase, attempt, stage, count] : tuples) {
    const auto named_phase = named<Phase>(phase);
    const auto named_stage = named<Stage>(stage);
    if (!named_phase || !named_stage || attempt < 0 || attempt >= kMaxAttempts || count < 0) {
      throw py::value_error(fmt::format("cuts: ({}, {}, {}, {}) is no cut of a plan", phase, attempt, stage, count));
    }
    cuts.push_back({*named_phase, attempt, *named_stage, count});
  }
  return cuts;
}

py::dict planes_of(const Plan& plan) {
  std::vector<std::int64_t> tracks, intervals, parts, of;
  const auto n = static_cast<Eigen::Index>(plan.certificate.size());
  Points normals(3, n);
  std::vector<double> offsets;
  for (Eigen::Index k = 0; k < n; ++k) {
    const CertificatePlane& plane = plan.certificate[idx(k)];
    tracks.push_back(plane.track);
    intervals.push_back(plane.interval);
    parts.push_back(plane.part);
    of.push_back(plane.parts);
    normals.col(k) = plane.plane.n;
    offsets.push_back(plane.plane.d);
  }
  py::dict planes;
  planes["track"] = array_of(std::move(tracks));
  planes["interval"] = array_of(std::move(intervals));
  planes["part"] = array_of(std::move(parts));
  planes["parts"] = array_of(std::move(of));
  planes["normal"] = array_of(normals);
  planes["offset"] = array_of(std::move(offsets));
  return planes;
}

py::dict cost_of(const PlanCost& cost) {
  py::dict terms;
  terms["distance_to_goal"] = cost.distance_to_goal;
  terms["jerk"] = cost.jerk;
  terms["attraction"] = cost.attraction;
  terms["repulsion"] = cost.repulsion;
  terms["total"] = cost.total;
  return terms;
}

py::object statistics_of(const Answer& answer) {
  if (!answer.statistics) return py::none();
  const PlanStatistics& s = *answer.statistics;
  py::dict counts;
  counts["expansions"] = s.expansions;
  counts["hulls"] = s.hulls;
  counts["solver_calls"] = s.solver_calls;
  counts["solver_iterations"] = s.solver_iterations;
  return counts;
}

py::object trajectory_of(const Plan& plan) {
  if (plan.outcome == PlanOutcome::NoPlan) return py::none();
  return py::cast(plan.trajectory);
}

void bind_answer(py::module_& m) {
  py::class_<Answer>(m, "Answer", "The answer to one request: PLAN.")
      .def_property_readonly(
          "outcome", [](const Answer& a) { return key(a.plan.outcome); },
          "optimized, search_only, keep_committed, evade or no_plan.")
      .def_property_readonly(
          "reason", [](const Answer& a) { return key(a.plan.reason); },
          "The reason for the outcome: none, infeasible, goal_blocked, stale_world …")
      .def_property_readonly("request_id", [](const Answer& a) { return a.plan.request_id; })
      .def_property_readonly(
          "trajectory", [](const Answer& a) { return trajectory_of(a.plan); }, "From t_s to rest; None for no_plan.")
      .def_property_readonly(
          "hold_us", [](const Answer& a) { return a.plan.hold.us; },
          "How long the end stays clear after the end; capped.")
      .def_property_readonly(
          "confidence", [](const Answer& a) { return a.plan.confidence; },
          "That an estimated track stays within the box that the certificate uses.")
      .def_property_readonly("alpha_scale", [](const Answer& a) { return a.plan.alpha_scale; })
      .def_property_readonly(
          "relaxed", [](const Answer& a) { return a.plan.relaxed; }, "Whether the start lay inside a hull.")
      .def_property_readonly(
          "local_goal", [](const Answer& a) { return array_of(a.plan.local_goal); }, "W, m.")
      .def_property_readonly(
          "sphere_radius", [](const Answer& a) { return a.plan.sphere_radius; }, "m")
      .def_property_readonly(
          "cost", [](const Answer& a) { return cost_of(a.plan.cost); }, "The terms by which the plan was chosen.")
      .def_property_readonly(
          "planes", [](const Answer& a) { return planes_of(a.plan); },
          "The certificate, a row per plane: track, interval, part, parts, normal (n, 3), offset. "
          "Points q of the vehicle have normal·q + offset <= 0, W, m.")
      .def_property_readonly(
          "cuts", [](const Answer& a) { return cuts_of(a.plan); },
          "Where the budget ended loops: (phase, attempt, stage, count).")
      .def_property_readonly("statistics", &statistics_of, "The work in counts; None for an answer from a log.")
      .def(
          "to_bytes",
          [](const Answer& a) {
            const Bytes bytes = encode(a.plan);
            return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
          },
          "The message PLAN. Equal bytes are equal answers, headers included.");
}

}  // namespace

void bind_plan(py::module_& m) {
  using namespace py::literals;
  bind_answer(m);
  m.def(
      "plan",
      [](const HorizonRequest& request, const PreparedWorld& world, const std::optional<std::vector<CutTuple>>& cuts) {
        std::optional<std::vector<BudgetCut>> where;
        if (cuts) where = cuts_of(*cuts);
        const py::gil_scoped_release release;
        return answer_of(request, world, where);
      },
      "request"_a, "world"_a, "cuts"_a = py::none(),
      "Plans: a function of its arguments. Without cuts, loops end by their own limits. Other Python threads run "
      "meanwhile.");
}

}  // namespace tern::python
