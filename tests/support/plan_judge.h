// Judges the answers of plan() by dense sampling and by the checker with all obstacles; flies plans in a closed loop.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/assurance.h"
#include "planner/planner.h"
#include "tests/support/planner_worlds.h"

namespace tern::support {

/// Returns the obstacles from which an answer must be separated: all tracks and map boxes. They have the share of α
/// that the plan applies, reduced as clear_start() reduces it. Boxes have the margin of their point nearest to the
/// start.
std::vector<PlanningObstacle> obstacles_for(const HorizonRequest& request, const PlanningWorld& world,
                                            const Assurance& assurance = {});

/// Returns in words what is wrong with an answer; empty if it is right. A new trajectory must start at t_s, pass
/// check_plan() against all obstacles, and be free of contact at all sampled times until its hold ends. A kept
/// trajectory must be the committed one and free of contact.
std::string fault_of(const Plan& plan, const HorizonRequest& request, const PlanningWorld& world,
                     const PlannerConfig& config);

/// The observations that plan() reports while it runs.
class RecordingObserver final : public PlanObserver {
 public:
  void enter(Stage stage) override { stages.push_back(stage); }
  void answer(const Plan& best_so_far) override { answers.push_back(best_so_far); }
  std::vector<Stage> stages;
  std::vector<Plan> answers;
};

/// A vehicle that requests a plan once per period and flies it without tracking error.
struct Loop {
  UTime t_s;
  TimedSpline committed;
  Limits limits;
  Body body;
  PlannerConfig config;
  Duration period{50'000};
  Box flight_box{Vec3::Constant(-1e4), Vec3::Constant(1e4)};
  std::vector<PlanOutcome> outcomes = {};  ///< one per step

  /// Plans once in the world that `world_at` returns for the request, adopts a new trajectory, and advances by one
  /// period.
  /// @return the answer
  Plan step(const std::function<PlanningWorld(const HorizonRequest&)>& world_at);
  [[nodiscard]] MotionSample now() const { return committed.sample(t_s); }
};

}  // namespace tern::support
