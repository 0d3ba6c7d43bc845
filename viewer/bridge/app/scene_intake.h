// Passes messages of the bus or of a log to the scene.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/batches.h"
#include "runtime/bus.h"
#include "viewer/bridge/scene.h"

namespace tern {

class FoxgloveLink;

/// Collects batches of sets and maps until they are complete.
class SceneIntake {
 public:
  explicit SceneIntake(Scene& scene) : scene_(scene) {}

  /// Also passes every message to Foxglove's clients. Call it before subscribe(). @param link  outlives the intake
  void pass_to(FoxgloveLink* link) { link_ = link; }

  /// Subscribes to every channel that the page shows, and for Foxglove to all channels, for a live flight.
  void subscribe(Bus& bus);
  /// Takes one message of a log.
  /// @param channel  without the vehicle's suffix
  /// @return false if the message was refused; true also for channels that the page does not show
  bool receive(std::string_view channel, std::span<const std::uint8_t> bytes, UTime at);
  /// Discards incomplete sets, for a jump in a log.
  void restart();

 private:
  template <class T>
  void take(const Channel<T>& channel, const T& message, UTime at);
  /// Passes a complete message on.
  template <class T>
  void feed(const T& complete);
  template <class T>
  void show(const Channel<T>& channel, const T& message, UTime at);
  void show_state(std::string_view channel, const UavState& state);

  Scene& scene_;
  FoxgloveLink* link_ = nullptr;  ///< null: no Foxglove
  BatchCollector<ObstacleTruth> truth_;
  BatchCollector<TrackSet> tracks_;
  MapAssembler maps_;
};

}  // namespace tern
