// Random legal scenarios with short flights, and the reasons with which a flight of one may end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/scenario/scenario.h"
#include "tests/support/virtual_flight.h"

namespace tern::testing {

struct LegalScenario {
  Scenario scenario;
  std::string yaml;  ///< the whole file, including the sections of the processes
};

/// Returns the scenario of a seed. Limits, body, sphere and holds are drawn from their whole ranges. There are at most
/// six obstacles of any motion, near and far, and up to two regions. The goal is about half a minute away for the
/// vehicle; the timeout is 3 × the flight time + 10 s.
LegalScenario legal_scenario(std::uint64_t seed);

/// Records the newest plan of a flight and how long it holds.
struct PromiseWatch final : FlightObserver {
  std::optional<UTime> world_zero;  ///< when the first request was sent
  UTime asked_at;                   ///< when the newest plan was requested
  UTime promised_until;             ///< end of the flown trajectory, including its hold
  PlanReason last_reason = PlanReason::None;
  Vec3 at = Vec3::Zero();  ///< start of the last request, W
  void on_request(const HorizonRequest& request) override;
  void on_plan(const Plan& plan) override;
};

/// The reason for the end of a flight.
enum class FlightReason {
  Reached,
  StartInObstacle,  ///< contact at the world's time 0
  WayBlocked,       ///< a grid search finds no path around static obstacles, and the planner reported it
  WayNarrow,        ///< the grid is too coarse to decide whether there is a path
  HeldUp,           ///< an obstacle moves at the vehicle or on the rest of its path
  HitAfterPromise,  ///< contact with a moving obstacle after the last hold had ended
  HitByNewcomer,    ///< contact with an obstacle that appeared too late for the last plan
};
inline constexpr int kFlightReasons = 7;
const char* to_string(FlightReason reason);

struct FlightJudgement {
  FlightReason reason = FlightReason::Reached;
  std::string fault;  ///< empty: the reason is true
};
FlightJudgement judge(const LegalScenario& legal, const VirtualFlight& flight, const PromiseWatch& watch);

}  // namespace tern::testing
