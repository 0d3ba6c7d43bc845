// Keeps the field of unseen movers from OBSTACLE_SIGHTINGS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/world/horizon.h"
#include "planner/unseen/unseen_watch.h"
#include "runtime/bus.h"

namespace tern {

/// Subscribes to OBSTACLE_SIGHTINGS. All calls come from the receiving thread.
class UnseenIntake {
 public:
  /// @param start  of the vehicle, where it takes off, W
  UnseenIntake(Bus& bus, const UnseenMovers& movers, const Vec3& start);

  /// Discards all knowledge if the request comes from another vehicle than the requests before.
  void set_vehicle(const HorizonRequest& request);
  /// Returns what is known now.
  [[nodiscard]] std::shared_ptr<const UnseenKnowledge> snapshot() const;
  /// Returns the missing input as text, or "" if there are pictures.
  [[nodiscard]] std::string missing() const;

 private:
  UnseenMovers movers_;
  Vec3 start_;
  UnseenWatch watch_;
  std::int64_t vehicle_epoch_us_ = 0;
};

}  // namespace tern
