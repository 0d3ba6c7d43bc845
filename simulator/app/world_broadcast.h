// Publishes the simulator's obstacles: detections, declared motions, the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/splines/motion_history.h"
#include "runtime/bus.h"
#include "simulator/app/simulator_config.h"
#include "simulator/inertial/navigation.h"
#include "simulator/worlds/coarse_motions.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Declared motions cover this much time before now …
inline constexpr Duration kDeclaredPast{100'000};
/// … and this much after: t_s, the longest plan and its hold (3.5 s), and the largest age of a fresh set.
inline constexpr Duration kDeclaredAhead{4'500'000};

/// Least time between two sets, so that all batches of one are sent before the next one.
inline constexpr Duration kDeclaredApart{20'000};

/// Makes the scenario's world, with data from data_folder(). @throws ConfigError for an Error of make_world.
World world_of(const Scenario& scenario);
/// As world_of(), and checks that DECLARED_MOTIONS can hold the world, unless config.declare is false.
/// @throws ConfigError as above, for too many obstacles at once, or for one that is too fast for the message.
World flyable_world_of(const Scenario& scenario, const SimulatorConfig& config);

/// Moves a frame from the true world to the believed one. Boxes keep their axes, because the believed yaw is off by
/// less than a degree.
void move_to(ObservationSet& set, const Belief& belief);

/// Publishes OBSTACLE_OBSERVATIONS at the sensor's rate and latency, OBSTACLE_TRUTH at 30 Hz, and DECLARED_MOTIONS at 5
/// Hz and at most kDeclaredApart after an obstacle appears. Motions with too many pieces are declared coarser.
///
/// | world        | until start()                        | from start() to world zero      | after world zero |
/// |--------------|--------------------------------------|---------------------------------|------------------|
/// | declared     | rests as at world time 0             | rests; motion declared from there on | moves       |
/// | not declared | only obstacles that never move exist | moves towards world time 0      | moves            |
///
/// A world that is not declared moves before world zero. A predictor that saw its movers at rest would learn that
/// stationary objects start at any moment.
class WorldBroadcast {
 public:
  WorldBroadcast(Bus& bus, const World& world, const SimulatorConfig& config, UTime now);

  void start(UTime world_zero, UTime now);
  [[nodiscard]] UTime next_wakeup() const;
  /// Publishes all due messages. The sensor is at the vehicle's true position at the time of each frame. Frames are
  /// published relative to the pose that `navigation` believes; nullptr: the true pose.
  void step(UTime now, const MotionHistory& uav, const Navigation* navigation = nullptr);
  /// The world that exists at a time, by the table above.
  [[nodiscard]] const World& world_at(UTime t) const { return is_before_world(t) ? before_ : world_; }
  /// Text about motions that did not fit into the newest declaration; empty: all fitted.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  void publish_observations(UTime now, const MotionHistory& uav, const Navigation* navigation);
  void publish_declared(UTime now, const Vec3& uav);
  void report_left_out(std::int32_t left_out, std::size_t of);
  void publish_truth(UTime now);
  [[nodiscard]] bool is_before_world(UTime t) const;
  [[nodiscard]] UTime declared_due() const;

  Bus& bus_;
  const World& world_;
  World before_;  ///< the obstacles until start(), or until world zero
  SimulatorConfig config_;
  UTime world_zero_ = kFarFuture;
  // Frames are numbered from the process's start, later from world zero; earlier frames then have negative numbers.
  UTime frames_zero_;
  std::int64_t frame_ = 0;
  std::int64_t declared_set_ = 0, truth_set_ = 0;
  CoarseMotions coarse_;
  std::vector<Duration> appearances_;  ///< world times of appearances still to declare, ascending
  std::string trouble_;
  UTime next_declared_, next_truth_;
  UTime last_declared_;

  static constexpr UTime kFarFuture{3'999'999'999'000'000};
};

}  // namespace tern
