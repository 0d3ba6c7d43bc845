// The referee: judges what the vehicle truly flew against the true obstacles.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/scenario/scenario.h"
#include "core/world/flight_result.h"
#include "simulator/referee/clearance.h"
#include "simulator/referee/flight_measures.h"
#include "simulator/worlds/appearances.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Judges one flight from consecutive cubic pieces of the vehicle's true motion, from world time 0 on.
///
/// | event that ends the flight                                    | verdict                                     |
/// |---------------------------------------------------------------|---------------------------------------------|
/// | within 0.2 m of the goal at under 0.1 m/s                     | Reached; Failed if a limit was violated     |
/// | clearance of an obstacle or of the map < 0, continuous time   | Collision                                   |
/// | scenario.timeout_s, or 3 × rest_to_rest_bound_s + 10 s        | Timeout                                     |
///
/// The first event decides. min_clearance_m is attained and at most kClearanceTolerance above the true minimum. After a
/// collision it includes the rest of that step (≤ 10 ms), so that it shows the depth. Pieces are cut to steps of at
/// most 10 ms; a step costs microseconds.
class Referee {
 public:
  /// @param judged  limits beyond which the true motion counts as a violation
  Referee(const Scenario& scenario, World world, const Limits& judged);
  /// Uses the scenario's limits.
  Referee(const Scenario& scenario, World world) : Referee(scenario, std::move(world), scenario.uav.limits) {}
  Referee(const Referee&) = delete;
  Referee& operator=(const Referee&) = delete;

  /// Sets the goal (W, m; at first the scenario's). nullopt: there is none, as in mode Hold.
  void set_goal(const std::optional<Vec3>& goal);
  /// Sets the earliest arrival, world time, s: for a vehicle that guards its place.
  void set_earliest_arrival(double t_s) { earliest_arrival_s_ = t_s; }
  [[nodiscard]] double earliest_arrival_s() const { return earliest_arrival_s_; }
  /// Takes speeds (arrival, stops, top speed, path length) from the velocities at the pieces' ends: for a vehicle whose
  /// states have time stamps that jitter. @pre each piece joins two states of the vehicle
  void trust_stated_velocities() { has_stated_velocities_ = true; }

  /// Sets the occupied voxels of the newest map, as boxes (cover_with_boxes()). A contact with one is a collision.
  /// @return an Error for a box beyond WorldObstacle::kMaxCoordinate; the map then stays as it was
  Result<void> set_map(const std::vector<Box>& occupied);
  /// Decides which obstacles that have appeared by world time t_s take part (Appearances). Call it before the other
  /// functions. @param vehicle  its position (W) at a world time
  void admit(double t_s, const std::function<Vec3(double)>& vehicle);

  /// Names of the obstacles that overlap the body at the scenario's start within [from_s, 0), world time, checked every
  /// 10 ms. Contacts before 0 do not count.
  [[nodiscard]] std::vector<std::string> passing_the_start(double from_s) const;

  /// Takes `piece`, flown from world time `start` on. Ignored after the verdict.
  /// @throws std::invalid_argument unless start is the end of the last piece (0 at first), duration > 0, and all
  /// coefficients are finite.
  void advance(Duration start, const CubicPiece& piece);

  [[nodiscard]] Duration now() const { return now_; }  ///< world time up to which the flight was taken
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] double timeout_s() const { return timeout_s_; }

  [[nodiscard]] std::optional<FlightResult> verdict() const;
  /// The measures so far. Before the verdict, outcome is Failed and detail states that the flight has not ended. NaN:
  /// min_clearance_m without any obstacle, min_map_clearance_m without an occupied voxel, first_entry_s without an
  /// entry, mean_speed_mps without an arrival. mean_speed_mps is also NaN if the goal changed in flight, as in a
  /// mission. Then the straight way from the start to the last goal was not flown.
  [[nodiscard]] FlightResult result_so_far() const;

 private:
  void step(const FlownPiece& piece, double t0_s, double t1_s);
  void end(FlightOutcome outcome, double t_s, std::string detail);
  [[nodiscard]] std::string describe_timeout(const Vec3& p) const;
  [[nodiscard]] std::string name_of(std::int64_t obstacle) const;
  [[nodiscard]] std::string describe(const Contact& contact, const std::string& what, const Vec3& p) const;

  [[nodiscard]] std::int64_t obstacles_met() const;
  [[nodiscard]] std::optional<double> arrival(const FlownPiece& piece, double t0_s, double t1_s) const;

  UavSpec uav_;
  std::optional<Vec3> goal_;
  bool goal_changed_ = false;  ///< in flight: replaced or withdrawn
  double earliest_arrival_s_ = 0.0;
  bool has_stated_velocities_ = false;
  World world_;
  Appearances appearances_;
  double timeout_s_;
  ClearanceWatch clearance_;
  World map_;  ///< its boxes as obstacles at rest
  std::optional<ClearanceWatch> map_clearance_;
  double min_map_clearance_m_ = std::numeric_limits<double>::infinity();
  LimitWatch limits_;
  FlightMeasures measures_;
  Duration now_;
  std::optional<MotionSample> last_;  ///< at the end of the last piece
  std::optional<double> first_entry_s_;
  std::optional<FlightOutcome> outcome_;
  double end_s_ = 0.0;
  std::int64_t left_out_ = 0;
  std::int64_t contacts_moving_ = 0, contacts_at_rest_ = 0;
  std::string detail_;
};

}  // namespace tern
