// What the simulator says of its obstacles: detections, declared motions, the truth.
#pragma once

#include <cstdint>

#include "executor/executor.h"
#include "runtime/bus.h"
#include "simulator/app/simulator_config.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Declared motions reach from this much before now …
inline constexpr Duration kDeclaredPast{100'000};
/// … to this much after: t_s, the longest plan and its hold (3.5 s), and the age of a set that is still fresh.
inline constexpr Duration kDeclaredAhead{4'500'000};

/// Publishes OBSTACLE_OBSERVATIONS at the sensor's rate and latency, DECLARED_MOTIONS at 5 Hz, OBSTACLE_TRUTH at 30 Hz.
/// Until start() the world rests as it is at world time 0, and is declared so; after it, it rests until world_zero and
/// is declared to move from there on.
class WorldBroadcast {
 public:
  WorldBroadcast(Bus& bus, const World& world, const SimulatorConfig& config, UTime now);

  void start(UTime world_zero, UTime now);
  [[nodiscard]] UTime next_wakeup() const;
  /// Publishes what is due; the sensor is where `uav` was when a frame was taken.
  void step(UTime now, const Executor& uav);

 private:
  void publish_observations(UTime now, const Executor& uav);
  void publish_declared(UTime now, const Vec3& uav);
  void publish_truth(UTime now);
  void choose_epoch();

  Bus& bus_;
  const World& world_;
  World resting_;  // the world at time 0, for ever
  SimulatorConfig config_;
  UTime world_zero_ = kFarFuture;
  // Frames count from the start of an epoch: the process's start while the world rests, then world zero.
  UTime frames_zero_;
  bool frames_rest_ = true;
  std::int64_t frame_ = 0;
  std::int64_t declared_set_ = 0, truth_set_ = 0;
  UTime next_declared_, next_truth_;

  static constexpr UTime kFarFuture{3'999'999'999'000'000};
};

}  // namespace tern
