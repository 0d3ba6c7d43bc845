// The true position of a simulated vehicle, in the estimator's frame before take-off.
#pragma once

#include <optional>

#include "core/world/vehicle.h"

namespace tern::mavlink {

/// The truth's frame is shifted so that the truth equals the estimate before take-off. A later difference is drift.
/// If the vehicle is armed when first seen, as by a restarted bridge, the truth equals the estimate of that time.
class TruthAnchor {
 public:
  /// The vehicle stands. Does nothing without a truth.
  void stand(const std::optional<UavState>& estimate, const std::optional<UavState>& truth);
  /// Takes truth and estimate of nearly the same time. @return true for the first such pair
  bool see(const std::optional<UavState>& estimate, const std::optional<UavState>& truth);
  /// Returns the shifted truth, or nullopt before the first pair.
  [[nodiscard]] std::optional<UavState> apply(std::optional<UavState> truth) const;

 private:
  std::optional<Vec3> shift_;
};

}  // namespace tern::mavlink
