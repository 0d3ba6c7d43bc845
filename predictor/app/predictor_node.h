// tern-predictor: observations and declared motions in, predictions out.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/world/observation.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "predictor/app/input_watch.h"
#include "predictor/app/predictor_config.h"
#include "predictor/tracking/tracker.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

inline constexpr Duration kBoundsPeriod{500'000};
/// So long must the process that speaks for a sensor be silent before another one is heard.
inline constexpr Duration kSensorSilence{1'000'000};

/// Publishes a complete set of predictions each period from the first input on, for ever: when inputs stop, made_at
/// stays and the α of what was tracked grows, so that the planner sees for itself how old the world is. A world without
/// obstacles is an empty set. made_at is the newest of the declared set's made_at and the observations' times, as far
/// as the model uses them. What is too old or repeated is not used and counted as late, as is what another process says
/// for a sensor whose own process was heard within kSensorSilence; what is stamped in the future does not come through
/// the bus.
///
/// Waiting until there is an input, while the newest is older than kInputsStopped, and while one that was used is
/// silent for so long: a dead sensor beside another input does not show in made_at. Troubles (a repeated input, tracks
/// that do not fit into a set) are said on HEARTBEAT in any state. Why the boxes of estimated tracks are as wide as
/// they are is published with the first set of each kBoundsPeriod.
class PredictorNode final : public Node {
 public:
  PredictorNode(Bus& bus, const PredictorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  void on_declared(const TrackSet& batch);
  void on_observations(const ObservationSet& observations);
  /// Of a sensor one process is heard at a time, as on a channel with one speaker.
  bool may_speak(const ObservationSet& observations, UTime now);
  void have_input(const std::string& input, UTime made_at);
  void publish(UTime now);
  /// Says why the set's tracks are as wide as they are, in its order. @param bounds  by id ascending
  void publish_bounds(const TrackSet& set, const std::vector<TrackBound>& bounds, UTime now);

  Bus& bus_;
  PredictorConfig config_;
  InputWatch watch_;
  struct Speaker {
    std::int64_t epoch_us = 0;
    UTime at;
  };
  std::map<std::int32_t, Speaker> speakers_;  // by sensor; none that has fallen silent
  BatchCollector<TrackSet> collector_;
  std::vector<Track> declared_;
  std::int32_t declared_left_out_ = 0;
  Tracker tracker_;
  std::optional<Vec3> vehicle_;   // W, m
  std::optional<UTime> made_at_;  // none: no input yet
  std::int64_t sets_ = 0;
  UTime next_ = kNever;
  UTime next_bounds_;
};

}  // namespace tern
