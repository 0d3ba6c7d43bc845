// Messages of the bus or of a log → the scene.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/batches.h"
#include "runtime/bus.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// Collects sets and maps until they are complete.
class SceneIntake {
 public:
  explicit SceneIntake(Scene& scene) : scene_(scene) {}

  /// Live: hears everything that the page shows.
  void subscribe(Bus& bus);
  /// One message of a log. @return false when it was refused; true also for channels that the page does not show.
  /// @param channel  without a vehicle's suffix
  bool receive(std::string_view channel, std::span<const std::uint8_t> bytes, UTime at);
  /// Forgets unfinished sets: the log jumps.
  void restart();

 private:
  template <class T>
  void take(const T& message, UTime at);

  Scene& scene_;
  BatchCollector<ObstacleTruth> truth_;
  BatchCollector<TrackSet> tracks_;
  MapAssembler maps_;
};

}  // namespace tern
