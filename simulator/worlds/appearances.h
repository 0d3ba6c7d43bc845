// Obstacles that appear beside the vehicle: the beginning of a recording, where a real person would have been seen.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "simulator/worlds/world.h"

namespace tern {

/// Leaves out of the flight each obstacle that appears nearer to the vehicle than its motion's leave_out_within_m.
/// @pre admit() is called for a time before an obstacle of that time is seen, declared or judged
class Appearances {
 public:
  explicit Appearances(const World& world);

  /// Decides about the obstacles that have appeared by world time t_s. @param vehicle  its position (W) at a world time
  /// @return the number of obstacles left out
  int admit(World& world, double t_s, const std::function<Vec3(double)>& vehicle);

 private:
  std::vector<std::pair<double, std::size_t>> undecided_;  ///< (world time s, obstacle), descending
};

}  // namespace tern
