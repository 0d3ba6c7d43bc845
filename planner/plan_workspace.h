// Memory that plan() uses again from call to call. It never changes an answer.
#pragma once

#include <cstdint>
#include <vector>

#include "core/world/horizon.h"
#include "planner/optimization/barrier_solver.h"
#include "planner/safety/separation_cache.h"
#include "planner/search/search_memory.h"

namespace tern {

/// Pass the same workspace to every call of one thread, and never to two calls at once. A fresh workspace gives the
/// same answers, byte for byte.
///
/// A request that is no larger than earlier ones allocates only its results, hulls and Ipopt's memory: see
/// tests/planner/allocation_test.cpp.
struct PlanWorkspace {
  std::vector<PlanningObstacle> obstacles;          ///< obstacles in reach of the request
  std::vector<PlanningObstacle> reduced_obstacles;  ///< the same at a reduced assurance
  std::vector<std::int32_t> found;                  ///< results of an index query
  std::vector<double> times;                        ///< interval ends of a horizon, s after t_s
  SweptHorizon committed;                           ///< along the committed trajectory
  SweptHorizon horizon;                             ///< of the current duration
  SweptHorizon evasion;                             ///< of the current stop
  SweptObstacles forecast;                          ///< of the forecast for all stops
  SearchMemory search;
  std::vector<CertificatePlane> certificates;  ///< planes near a trajectory
  std::vector<PlaneConstraint> planes;         ///< the same as constraints of the solver
  ConvexProblem convex;
  BarrierSolver barrier;
};

}  // namespace tern
