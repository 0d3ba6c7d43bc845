// The referee: watches what the vehicle truly flies against what is truly there, and judges (BENCHMARKS: measures).
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/world/flight_result.h"
#include "core/world/scenario.h"
#include "simulator/referee/clearance.h"
#include "simulator/referee/flight_measures.h"
#include "simulator/worlds/appearances.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Judges one flight, fed as consecutive cubic pieces of the vehicle's true motion from world time 0 on.
///
/// The flight ends, and the verdict stands, at the first of three:
///  - Arrival within 0.2 m of the goal at under 0.1 m/s: Reached, or Failed if a limit or the flight box was ever left.
///  - Clearance of obstacles or of the map below 0 in continuous time: Collision.
///  - scenario.timeout_s, or 3 × rest_to_rest_bound_s + 10 s: Timeout.
/// min_clearance_m is attained and at most kClearanceTolerance above the true minimum. With a collision it is taken
/// until the end of that step (≤ 10 ms), so that it says how deep. Pieces are cut to steps of at most 10 ms; a step
/// costs microseconds.
class Referee {
 public:
  /// @param judged  the limits beyond which the true motion counts as a violation
  Referee(const Scenario& scenario, World world, const Limits& judged);
  /// The scenario's own limits.
  Referee(const Scenario& scenario, World world) : Referee(scenario, std::move(world), scenario.uav.limits) {}
  Referee(const Referee&) = delete;
  Referee& operator=(const Referee&) = delete;

  /// From here on the flight shall end at `goal` (W, m; the scenario's at first); nullopt: nowhere, as while it holds.
  void set_goal(const std::optional<Vec3>& goal);
  /// An arrival counts only from this world time on, s: for a vehicle that guards the place where it is.
  void set_earliest_arrival(double t_s) { earliest_arrival_s_ = t_s; }

  /// The occupied voxels of the newest map, as boxes (cover_with_boxes()): from now on a contact with one of them is a
  /// collision too. An error leaves the map as it was: a box beyond WorldObstacle::kMaxCoordinate.
  Result<void> set_map(const std::vector<Box>& occupied);
  /// Decides who of those who appeared by world time t_s is part of the flight (Appearances); call it first.
  /// @param vehicle  where it was at a world time, W
  void admit(double t_s, const std::function<Vec3(double)>& vehicle);

  /// Names of those that overlap the body at the scenario's start within [from_s, 0), world time, every 10 ms: while
  /// all wait, what is on its way passes through it. No contact counts before 0.
  [[nodiscard]] std::vector<std::string> passing_the_start(double from_s) const;

  /// The vehicle flew `piece` from world time `start` on. After the verdict nothing is taken any more.
  /// @throws std::invalid_argument unless start is where the last piece ended (0 at first), duration > 0, coefficients
  /// finite.
  void advance(Duration start, const CubicPiece& piece);

  [[nodiscard]] Duration now() const { return now_; }  ///< how far the flight was told
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] double timeout_s() const { return timeout_s_; }

  [[nodiscard]] std::optional<FlightResult> verdict() const;
  /// The measures until now; before the verdict outcome is Failed and detail says that the flight has not ended.
  /// NaN: min_clearance_m where no obstacle was ever present, min_map_clearance_m where no voxel was occupied,
  /// first_entry_s and mean_speed_mps where there is none.
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
  double earliest_arrival_s_ = 0.0;
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
