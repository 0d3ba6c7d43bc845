// What the simulator says of its obstacles: detections, declared motions, the truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/splines/motion_history.h"
#include "runtime/bus.h"
#include "simulator/app/simulator_config.h"
#include "simulator/worlds/coarse_motions.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Declared motions reach from this much before now …
inline constexpr Duration kDeclaredPast{100'000};
/// … to this much after: t_s, the longest plan and its hold (3.5 s), and the age of a set that is still fresh.
inline constexpr Duration kDeclaredAhead{4'500'000};

/// Sets of motions are at least this far apart, so that the batches of one have left before the next comes.
inline constexpr Duration kDeclaredApart{20'000};

/// The world of the scenario, its data from data_folder(). @throws ConfigError for make_world's Errors.
World world_of(const Scenario& scenario);
/// The same, if what moves in it can be declared, or if config.declare is false. @throws ConfigError, too, for more
/// obstacles at once than a set of DECLARED_MOTIONS holds, or one faster than a message may say.
World flyable_world_of(const Scenario& scenario, const SimulatorConfig& config);

/// Publishes OBSTACLE_OBSERVATIONS at the sensor's rate and latency, DECLARED_MOTIONS at 5 Hz and when someone appears
/// (kDeclaredApart later at most), OBSTACLE_TRUTH at 30 Hz. Motions with too many pieces are declared coarser.
///
/// Until start() a declared world rests as it is at world time 0, and is declared so. Then it rests until world_zero
/// and is declared to move from there on. Of a world that is not declared only what never moves is there until start().
/// Then it moves on its way to world time 0: who saw its movers rest till then would learn that what rests starts at
/// any moment.
class WorldBroadcast {
 public:
  WorldBroadcast(Bus& bus, const World& world, const SimulatorConfig& config, UTime now);

  void start(UTime world_zero, UTime now);
  [[nodiscard]] UTime next_wakeup() const;
  /// Publishes what is due; the sensor is where the vehicle truly was when a frame was taken.
  void step(UTime now, const MotionHistory& uav);
  /// Motions that the newest declaration had to leave out, as text; empty: none.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  void publish_observations(UTime now, const MotionHistory& uav);
  void publish_declared(UTime now, const Vec3& uav);
  void report_left_out(std::int32_t left_out, std::size_t of);
  void publish_truth(UTime now);
  [[nodiscard]] bool is_before_world(UTime t) const;
  [[nodiscard]] UTime declared_due() const;

  Bus& bus_;
  const World& world_;
  World before_;  // what is there until start(), or until world zero
  SimulatorConfig config_;
  UTime world_zero_ = kFarFuture;
  // Frames count from the process's start, then from world zero: those before that have numbers below 0.
  UTime frames_zero_;
  std::int64_t frame_ = 0;
  std::int64_t declared_set_ = 0, truth_set_ = 0;
  CoarseMotions coarse_;
  std::vector<Duration> appearances_;  // ascending world times, those that were declared are gone
  std::string trouble_;
  UTime next_declared_, next_truth_;
  UTime last_declared_;

  static constexpr UTime kFarFuture{3'999'999'999'000'000};
};

}  // namespace tern
