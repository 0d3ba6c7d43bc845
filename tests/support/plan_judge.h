// Judges what plan() answers by dense sampling and by the checker with every obstacle in it; flies plans in a closed
// loop.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/assurance.h"
#include "planner/planner.h"
#include "tests/support/planner_worlds.h"

namespace tern::support {

/// The obstacles from which an answer must be separated: all tracks and map boxes, α as the plan counts it, scaled as
/// clear_start() has it.
std::vector<PlanningObstacle> obstacles_for(const HorizonRequest& request, const PlanningWorld& world,
                                            const Assurance& assurance = {});

/// What is wrong with the answer; empty: nothing. A new trajectory must begin at t_s, pass check_plan()
/// against all obstacles and touch nothing at any sampled instant until its hold ends. A kept one must be the committed
/// one and touch nothing either.
std::string fault_of(const Plan& plan, const HorizonRequest& request, const PlanningWorld& world,
                     const PlannerConfig& config);

/// What plan() says on the way.
class RecordingObserver final : public PlanObserver {
 public:
  void enter(Stage stage) override { stages.push_back(stage); }
  void answer(const Plan& best_so_far) override { answers.push_back(best_so_far); }
  std::vector<Stage> stages;
  std::vector<Plan> answers;
};

/// A vehicle that asks once per period and flies what it is answered, perfectly.
struct Loop {
  UTime t_s;
  TimedSpline committed;
  Limits limits;
  Body body;
  PlannerConfig config;
  Duration period{50'000};
  Box flight_box{Vec3::Constant(-1e4), Vec3::Constant(1e4)};
  std::vector<PlanOutcome> outcomes = {};  ///< one per step

  /// Plans once in the world that `world_at` gives for the request, adopts a new trajectory, goes on by a period.
  /// @return the answer.
  Plan step(const std::function<PlanningWorld(const HorizonRequest&)>& world_at);
  [[nodiscard]] MotionSample now() const { return committed.sample(t_s); }
};

}  // namespace tern::support
