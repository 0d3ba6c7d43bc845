// What plan() uses again from call to call: memory, never meaning.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/horizon.h"
#include "planner/optimization/barrier_solver.h"
#include "planner/safety/swept_obstacles.h"
#include "planner/search/search_memory.h"

namespace tern {

/// Give the same one to every call of a thread. Once it has seen requests as large, obstacles in reach, sweeps, search,
/// convex problem and its solver allocate nothing. A fresh one gives the same answers, byte for byte. Not for two calls
/// at once.
struct PlanWorkspace {
  std::vector<PlanningObstacle> obstacles;  ///< in reach of this request
  std::vector<std::int32_t> found;          ///< of an index
  std::vector<double> times;                ///< of a horizon
  SweptObstacles committed;                 ///< along what is flown if nothing new is
  SweptObstacles horizon;                   ///< of the duration being tried
  SweptObstacles evasion, forecast;         ///< of one evasion, of all
  SearchMemory search;
  std::vector<CertificatePlane> certificates;  ///< planes near a trajectory
  std::vector<PlaneConstraint> planes;         ///< the same for a solver
  ConvexProblem convex;
  BarrierSolver barrier;
};

}  // namespace tern
