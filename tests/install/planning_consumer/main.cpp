// planning_consumer LOG: plans every request of a recorded flight. Exit code 0 if each plan has the recorded bytes.
#include <cstdio>

#include "messages/codec.h"
#include "planner/planner.h"
#include "predictor/tracking/tracker.h"
#include "tools/replay/recorded_problems.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto inputs = tern::read_recorded_inputs(argv[1]);
  if (!inputs) return std::fprintf(stderr, "%s\n", inputs.error().message.c_str()), 2;
  int same = 0, different = 0;
  const auto contents = tern::visit_answers(argv[1], *inputs, {}, [&](std::size_t index, tern::WorldRebuilder& world) {
    const tern::Plan& recorded = inputs->plans[index].plan;
    const auto problem = world.problem_of(recorded);
    if (!problem) return void(++different);
    tern::Budget budget = tern::Budget::replay(recorded.cuts);
    tern::Plan plan = tern::plan(problem->request, problem->world, problem->config, budget).plan;
    // The planner's process adds these.
    plan.header = recorded.header;
    plan.inputs.configuration_hash = recorded.inputs.configuration_hash;
    plan.inputs.planner_build = recorded.inputs.planner_build;
    ++(tern::encode(plan) == tern::encode(recorded) ? same : different);
  });
  if (!contents) return 2;
  const tern::Tracker tracker{tern::TrackerConfig{}};
  std::printf("%d plans have the recorded bytes, %d others\n", same, different);
  return same > 0 && different == 0 && tracker.objects().empty() ? 0 : 1;
}
