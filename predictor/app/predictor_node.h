// The node of tern-predictor: observations and declared motions in, predictions out.
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
/// Another process may send a sensor's sets after the first one was silent for this long.
inline constexpr Duration kSensorSilence{1'000'000};

/// Receives observations and declared motions, and publishes predictions.
///
/// - From the first input on, it publishes a complete set of PREDICTIONS each period. An empty world is an empty set.
/// - made_at is the time of the newest input that the model uses: made_at of a declared set, or the time of an
///   observation set. When all inputs stop, made_at stays and α of estimated tracks grows, so the planner sees the age.
/// - Observation sets are counted as late and not used if they are too old, repeated, or sent by a second process. The
///   bus rejects sets with a time in the future.
/// - TRACK_BOUNDS, the reason for each estimated track's width, is published with the first set of each kBoundsPeriod.
///
/// | HEARTBEAT            | while                                                                           |
/// |----------------------|---------------------------------------------------------------------------------|
/// | Waiting              | there was no input; the newest is older than kInputsStopped; an input is silent |
/// | Ready                | otherwise                                                                       |
/// | a trouble, any state | it happened within kTroubleReported, for example tracks that do not fit a set   |
class PredictorNode final : public Node {
 public:
  PredictorNode(Bus& bus, const PredictorConfig& config);

  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  void on_declared(const TrackSet& batch);
  void on_observations(const ObservationSet& observations);
  /// True if the sender is the active one of its sensor: one process per sensor_id, as on a channel with one sender.
  bool is_active_sender(const ObservationSet& observations, UTime now);
  void have_input(const std::string& input, UTime made_at);
  void publish(UTime now);
  /// Publishes the bounds of the set's estimated tracks, in its order. @param bounds  ascending by id
  void publish_bounds(const TrackSet& set, const std::vector<TrackBound>& bounds, UTime now);

  Bus& bus_;
  PredictorConfig config_;
  InputWatch watch_;
  struct Sender {
    std::int64_t epoch_us = 0;
    UTime at;
  };
  std::map<std::int32_t, Sender> senders_;  // by sensor; silent ones are removed
  BatchCollector<TrackSet> collector_;
  std::vector<Track> declared_;
  std::int32_t declared_left_out_ = 0;
  Tracker tracker_;
  std::optional<Vec3> vehicle_;   // W, m
  std::optional<UTime> made_at_;  // empty: no input yet
  std::int64_t sets_ = 0;
  UTime next_ = kNever;
  UTime next_bounds_;
};

}  // namespace tern
