#include "campaign/experiments/flight_track.h"

#include "campaign/virtual_system.h"
#include "core/world/vehicle.h"
#include "messages/channels.h"
#include "simulator/app/simulator_node.h"
#include "simulator/app/world_broadcast.h"

namespace tern {
namespace {

constexpr Duration kStep{50'000};
constexpr Duration kMaxFlight{600LL * 1'000'000};

}  // namespace

FlightTrack fly_and_track(const std::string& scenario_file, const std::vector<std::string>& overrides) {
  VirtualSystem system(scenario_file, overrides);
  FlightTrack track;
  track.scenario = system.scenario();
  track.world = world_of(track.scenario);
  VirtualRunner& runner = system.runner();
  const SimulatorNode& simulator = system.simulator();
  UTime next{0};
  runner.observer().subscribe(channels::kUavState, [&](const UavState& state) {
    if (!simulator.world_zero() || state.at < next) return;
    track.points.push_back({(state.at - *simulator.world_zero()).seconds(), state.motion.p, state.motion.v.norm()});
    next = state.at + kStep;
  });
  runner.run(runner.now() + kMaxFlight, [&] { return simulator.result().has_value(); });
  return track;
}

}  // namespace tern
