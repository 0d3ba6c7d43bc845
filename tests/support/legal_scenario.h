// Random scenarios that a user may legally write, with short flights, and what a flight of each may end with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/world/scenario.h"
#include "tests/support/virtual_flight.h"

namespace tern::testing {

struct LegalScenario {
  Scenario scenario;
  std::string yaml;  ///< the whole file, process sections included
};

/// Limits, body, sphere, holds from all of their ranges; at most six obstacles of any motion, near and far; up to two
/// regions. The goal is as far as such a vehicle flies within half a minute or so; the timeout is 3 × that + 10 s. A
/// pure function of the seed.
LegalScenario legal_scenario(std::uint64_t seed);

/// Notes what a flight promised last.
struct PromiseWatch final : FlightObserver {
  std::optional<UTime> world_zero;  ///< the first request comes then
  UTime asked_at;                   ///< when the newest plan was asked for
  UTime promised_until;             ///< by what is flown, the hold after it included
  PlanReason last_reason = PlanReason::None;
  Vec3 at = Vec3::Zero();  ///< where the last request began, W
  void on_request(const HorizonRequest& request) override;
  void on_plan(const Plan& plan) override;
};

/// Why a flight ended as it did.
enum class FlightReason {
  Reached,
  StartInObstacle,  ///< touched at world time 0
  WayBlocked,       ///< a grid search finds no way around what stands, and the planner said so
  WayNarrow,        ///< the grid is too coarse to tell whether there is a way
  HeldUp,           ///< something moves where the vehicle, or what is left of its way, is
  HitAfterPromise,  ///< touched by a mover when the last hold had ended
  HitByNewcomer,    ///< touched by what came into being too late for the last plan
};
inline constexpr int kFlightReasons = 7;
const char* to_string(FlightReason reason);

struct FlightJudgement {
  FlightReason reason = FlightReason::Reached;
  std::string fault;  ///< empty: the flight ended with a reason that is true
};
FlightJudgement judge(const LegalScenario& legal, const VirtualFlight& flight, const PromiseWatch& watch);

}  // namespace tern::testing
