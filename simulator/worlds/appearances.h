// Who appears out of nothing beside the vehicle: there a recording begins, not a person.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "simulator/worlds/world.h"

namespace tern {

/// Leaves out of a flight whoever appears in it nearer to the vehicle than its motion's leave_out_within_m. Before
/// anyone sees, declares or judges what is there at a time, admit() must have been called for that time.
class Appearances {
 public:
  explicit Appearances(const World& world);

  /// Decides about those who have appeared by world time t_s. @param vehicle  where it was at a world time, W
  /// @return how many were left out.
  int admit(World& world, double t_s, const std::function<Vec3(double)>& vehicle);

 private:
  std::vector<std::pair<double, std::size_t>> undecided_;  ///< (world time s, obstacle), the last one comes first
};

}  // namespace tern
