// The fences that a ground station uploads, in the mapper.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/world/fence_set.h"
#include "core/world/voxel_map.h"
#include "runtime/bus.h"

namespace tern {

/// Receives FENCES, and adds what they forbid to maps.
///
/// | FENCES                                            | effect                                               |
/// |---------------------------------------------------|------------------------------------------------------|
/// | none has come                                     | no map is published: a restart must not lose fences  |
/// | that are as those before                          | none                                                 |
/// | that are other ones                               | they take the place of those before                  |
/// | with a polygon that crosses itself                | refused: those before stay, HEARTBEAT names the why  |
/// | that the map cannot hold (uploaded_fence_labels)  | the same                                             |
class FenceUploads {
 public:
  /// @param grid  of all maps that are given to onto()
  FenceUploads(Bus& bus, const VoxelGrid& grid, const Box& flight_box);

  /// Whether a map may be published.
  [[nodiscard]] bool has_taken() const { return labels_.has_value(); }
  /// Whether the fences have changed since the last call of onto().
  [[nodiscard]] bool has_changed() const { return has_changed_; }
  /// Returns the map with the fences. @pre has_taken()
  VoxelMap onto(VoxelMap map);
  /// The text for HEARTBEAT: what is waited for, or why the newest FENCES are not used; else "".
  [[nodiscard]] std::string text() const;

 private:
  void receive(const FenceSet& set);
  [[nodiscard]] std::string take(const std::vector<Fence>& fences);

  VoxelGrid grid_;
  Box flight_box_;
  std::optional<std::vector<VoxelLabel>> labels_;  ///< of the fences in force; nullopt: none have been taken
  std::vector<Fence> heard_;                       ///< the newest ones
  bool has_heard_ = false, has_changed_ = false;
  std::string refused_;  ///< why the newest ones are not used; ""
};

}  // namespace tern
