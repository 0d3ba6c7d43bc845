// Visits the answers of a log at the moments at which their inputs can be rebuilt.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/base/result.h"
#include "tools/replay/recorded_inputs.h"
#include "tools/replay/replay.h"
#include "tools/replay/world_rebuilder.h"

namespace tern {

/// Receives an answer's index in RecordedInputs::plans, and the rebuilder, which has the answer's prediction set now.
/// An exception ends the visit and is passed on.
using UseAnswer = std::function<void(std::size_t index, WorldRebuilder& world)>;

/// Visits each answer that `options` select, in the order in which their prediction sets were complete. Answers whose
/// set is not in the log come last.
///
///     const Result<RecordedInputs> inputs = read_recorded_inputs("flight.lcm");
///     visit_answers("flight.lcm", *inputs, {}, [&](std::size_t index, WorldRebuilder& world) {
///       const Plan& recorded = inputs->plans[index].plan;
///       const Result<PlanProblem> problem = world.problem_of(recorded);  // request, world, configuration
///       if (problem) use(replan(*problem, recorded).plan);               // the recorded bytes again
///     });
///
/// @param inputs  of the same log
/// @return the log's contents as far as predictions are concerned; an Error if the log cannot be opened
Result<LogContents> visit_answers(const std::string& path, const RecordedInputs& inputs, const ReplayOptions& options,
                                  const UseAnswer& use);

}  // namespace tern
