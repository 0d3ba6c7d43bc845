// Keeps the field of unseen movers from OBSTACLE_SIGHTINGS.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/world/horizon.h"
#include "planner/unseen/unseen_watch.h"
#include "runtime/bus.h"

namespace tern {

/// A vehicle takes off if its request starts within kStartReach of its start, and its committed trajectory is no longer
/// than kLongestRest, m. A hover's noise makes it move a little.
inline constexpr double kStartReach = 1.0, kLongestRest = 0.1;

/// Subscribes to OBSTACLE_SIGHTINGS. All calls come from the receiving thread.
class UnseenIntake {
 public:
  /// @param start  of the vehicle, where it takes off, W
  UnseenIntake(Bus& bus, const UnseenMovers& movers, const Vec3& start);

  /// Adapts the knowledge to the vehicle of a request.
  ///
  /// | request                                                     | effect                                       |
  /// |-------------------------------------------------------------|----------------------------------------------|
  /// | the first one, at take-off                                  | none                                         |
  /// | the first one, elsewhere: the planner was started in flight | all is forgotten, and nothing is clear       |
  /// | of another executor, at take-off                            | all is forgotten, and its take-off is clear  |
  /// | of another executor, elsewhere                              | all is forgotten, and nothing is clear       |
  /// | elsewhere, while there is no picture                        | that picture will find nothing clear         |
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
