// A flight on virtual time whose plans are made by the caller: the flight stops at each request until it is answered.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/world/flight_result.h"
#include "monitor/flight_watch.h"
#include "python/planning.h"

namespace tern {
class VirtualSystem;
}

namespace tern::python {

class SteppedPlanner;

/// Simulator, executor, predictor and mapper of a scenario on one virtual clock, and a planner that asks the caller.
/// Equal scenarios, settings and answers give equal flights.
///
///     VirtualFlight flight("corridor_demo.yaml", {"seed=7"});
///     while (flight.advance()) {
///       flight.answer(answer_of(flight.request(), flight.world({2.0, 2.0}), std::nullopt));
///     }
class VirtualFlight {
 public:
  /// An answer is sent this long after its request, as in a campaign with `--charge counts`.
  static constexpr Duration kAnswerLatency{15'000};

  /// @throws ConfigError for inputs that the processes would refuse
  VirtualFlight(const std::string& scenario_file, const std::vector<std::string>& settings);
  ~VirtualFlight();

  /// Runs until a request is open or the flight has ended. An open request stays without an answer.
  /// @return whether a request is open
  bool advance();
  /// Returns the open request. @throws std::logic_error if none is open
  [[nodiscard]] const HorizonRequest& request() const;

  /// The weights of regions in the cost of a plan.
  struct Weights {
    double attractive = 2.0, repulsive = 2.0;  ///< λ_att, λ_rep, ≥ 0
  };
  /// Returns the scenario's weights.
  [[nodiscard]] Weights weights() const;
  /// Returns the world of the open request for these weights. Fields of map and goal are made when map, goal or weights
  /// are new.
  [[nodiscard]] PreparedWorld world(const Weights& weights);
  /// Sends the answer to the open request. @throws std::logic_error if none is open
  void answer(const Plan& plan);

  [[nodiscard]] UTime now() const;
  /// Returns the verdict; nullopt while the vehicle flies.
  [[nodiscard]] const std::optional<Ending>& ending() const { return ending_; }
  /// Returns the referee's measures, once it has judged.
  [[nodiscard]] std::optional<FlightResult> result() const;

 private:
  std::unique_ptr<VirtualSystem> system_;
  std::unique_ptr<FlightWatch> watch_;
  SteppedPlanner* planner_ = nullptr;
  std::optional<Ending> ending_;
};

}  // namespace tern::python
