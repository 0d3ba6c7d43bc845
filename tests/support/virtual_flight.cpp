#include "tests/support/virtual_flight.h"

#include "campaign/virtual_system.h"
#include "executor/app/executor_node.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"

namespace tern {
namespace {

/// No flight of a scenario lasts longer, virtual time.
constexpr Duration kLongestFlight{3600LL * 1'000'000};

}  // namespace

VirtualFlight fly_virtually(const std::string& scenario_file, const std::vector<std::string>& overrides,
                            FlightObserver* observer) {
  VirtualSystem system(scenario_file, overrides);
  VirtualRunner& runner = system.runner();
  VirtualFlight flight;
  Bus& bus = runner.observer();
  bus.subscribe(channels::kPlan, [&](const Plan& plan) {
    ++flight.outcomes[static_cast<std::size_t>(plan.outcome)];
    ++flight.reasons[static_cast<std::size_t>(plan.reason)];
    if (observer != nullptr) observer->on_plan(plan);
  });
  bus.subscribe(channels::kHorizonRequest, [&](const HorizonRequest& request) {
    if (observer != nullptr) observer->on_request(request);
  });
  bus.subscribe(channels::kPlanTiming, [&](const PlanTiming& t) { flight.timings.push_back(t); });
  const SimulatorNode& simulator = system.simulator();
  const RunResult run = runner.run(runner.now() + kLongestFlight, [&] { return simulator.result().has_value(); });
  if (simulator.result()) flight.result = *simulator.result();
  if (run.end == RunEnd::Finished) flight.end = run.process + " ended with exit code " + std::to_string(run.exit_code);
  if (run.end == RunEnd::Time) flight.end = "no end within an hour";
  flight.executor = system.executor().counters();
  return flight;
}

}  // namespace tern
