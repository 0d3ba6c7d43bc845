// The message FENCES: geofences that a ground station has uploaded.
#pragma once

#include <vector>

#include "core/wire/header.h"
#include "core/world/fence.h"

namespace tern {

/// The newest message takes the place of those before it. Without fences it takes them away.
struct FenceSet {
  Header header;
  std::vector<Fence> fences;  ///< in W, without names, unbounded in height
};
inline constexpr int kMaxFencesPerMessage = 1'000;
inline constexpr int kMaxFenceCornersPerMessage = 1'000;

}  // namespace tern
