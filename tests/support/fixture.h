// One recorded request with its world, as the planner had it, for unit tests.
#pragma once

#include <string>
#include <utility>

#include "tools/replay/world_rebuilder.h"

namespace tern {

struct Fixture {
  PlanProblem problem;
  Plan answer;  ///< the recorded answer
};

/// Returns the first answer, with its problem, of a log or of a file of write_fixture().
/// @return an Error that names the missing input
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
