// One request with its world, as a planner had it: a flight's moment as a unit test.
#pragma once

#include <string>
#include <utility>

#include "tools/replay/world_rebuilder.h"

namespace tern {

struct Fixture {
  PlanProblem problem;
  Plan answer;  ///< what the planner made of it then
};

/// The first answer of a log or of what write_fixture wrote, with its problem. @return an Error that names what is
/// missing.
inline Result<Fixture> load_fixture(const std::string& path) {
  auto inputs = read_recorded_inputs(path);
  if (!inputs) return tl::make_unexpected(inputs.error());
  if (inputs->plans.empty()) return fail(path + ": holds no answer");
  const Plan& answer = inputs->plans.front().plan;
  WorldRebuilder rebuilder(*inputs, {});
  Result<PlanProblem> problem = rebuilder.problem_of(answer);
  const auto read = read_prediction_sets(path, "", [&](TrackSet set) {
    rebuilder.add(std::move(set));
    if (!problem) problem = rebuilder.problem_of(answer);
  });
  if (!read) return tl::make_unexpected(read.error());
  if (!problem) return fail(path + ": does not hold " + problem.error().message);
  return Fixture{std::move(*problem), answer};
}

}  // namespace tern
