// The node of tern-predictor: observations and declared motions in, predictions out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "predictor/app/active_senders.h"
#include "predictor/app/input_watch.h"
#include "predictor/app/predictor_config.h"
#include "predictor/app/sensor_frame.h"
#include "predictor/models/world_error.h"
#include "predictor/tracking/tracker.h"
#include "runtime/batches.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

inline constexpr Duration kBoundsPeriod{500'000};
/// Observation sets that waited longer in this process are skipped if newer ones wait.
inline constexpr Duration kMaxWait{100'000};
/// The most observation sets that wait: some 0.5 s of sixteen cameras. The oldest is skipped for one more.
inline constexpr std::size_t kMaxWaitingSets = 256;
/// step() begins no further observation set after this time.
inline constexpr Duration kMaxWorkPerStep{20'000};
/// The oldest observation set that is used, by the clock. Sensors are never that late: its time is in another unit.
inline constexpr Duration kMaxAge{10'000'000};

/// Receives observations and declared motions, and publishes predictions.
///
/// - From the first input on, it publishes a complete set of PREDICTIONS each period. An empty world is an empty set.
/// - made_at is the time of the newest input that the model uses: made_at of a declared set, or the time of an
///   observation set. When all inputs stop, made_at stays and α of estimated tracks grows, so the planner sees the age.
/// - A sensor sends detections (OBSTACLE_OBSERVATIONS) or sightings (OBSTACLE_SIGHTINGS). Below, a message of either
///   kind is an observation set.
/// - Observation sets are counted as late and not used if they are too old, repeated, or sent by a second process. The
///   same holds while kMaxSensors other sensors send. The bus rejects sets with a time in the future.
/// - Observation sets wait until step(). One that waited longer than kMaxWait is skipped if a newer one of its sensor
///   waits, or kMaxWaitingSets do, and counted as late. step() takes kMaxWorkPerStep and one set at most, so that
///   heartbeats and signals wait no longer, however many sets have arrived. A set out of order may take some 150 ms
///   (kMaxReplayed).
/// - A set is sent whole before the next observation set is used: a part of it serves nobody. The runner sends a batch
///   after each step, so long steps between them would keep a large set from being complete in time.
/// - A track or message that every receiver would refuse is not sent but counted, and HEARTBEAT names its field.
/// - With ODOMETRY, declared tracks get a margin for the error of the vehicle's pose in W (models/world_error.h).
///   Estimated tracks get none, because the vehicle sees them relative to itself.
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

  [[nodiscard]] UTime next_wakeup() const override {
    if (is_sending()) return kNever;
    return waiting_.empty() ? next_ : std::min(next_, waiting_[0].arrived);
  }
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;

 private:
  /// Whether batches of the last set are still to be sent.
  [[nodiscard]] bool is_sending() const { return bus_.next_due() != kNever; }
  void on_declared(const TrackSet& batch);
  void on_frame(SensorFrame frame);
  void use_waiting();
  void use(SensorFrame frame);
  /// Counts and reports an observation set that is skipped for a newer one.
  void skip(const SensorFrame& frame, UTime now);
  void have_input(const std::string& input, UTime made_at);
  void publish(UTime now);
  /// Publishes the bounds of the set's estimated tracks, in its order. @param bounds  ascending by id
  void publish_bounds(const TrackSet& set, const std::vector<TrackBound>& bounds, UTime now);

  /// Why receivers would refuse this message; nullopt if they would not.
  template <class T>
  [[nodiscard]] std::optional<std::string> refusal(T message, UTime now) const;
  void report_unsendable(const char* channel, const std::string& why, UTime now);
  /// Removes, counts and reports tracks that receivers would refuse. @return false if they would refuse the set even so
  bool remove_unsendable(std::vector<TrackSet>& batches, UTime now);

  Bus& bus_;
  PredictorConfig config_;
  InputWatch watch_;
  ActiveSenders senders_;
  struct Waiting {
    SensorFrame frame;
    UTime arrived;
  };
  std::deque<Waiting> waiting_;  // in the order of their arrival
  BatchCollector<TrackSet> collector_;
  std::vector<Track> declared_;
  std::int32_t declared_left_out_ = 0;
  Tracker tracker_;
  std::optional<Vec3> vehicle_;   // W, m
  WorldError world_error_;        // of things known in W, if the vehicle estimates its own pose
  std::optional<UTime> made_at_;  // empty: no input yet
  std::int64_t sets_ = 0;
  std::int64_t unsendable_ = 0;  // tracks and messages that receivers would refuse
  UTime next_ = kNever;
  UTime next_bounds_;
};

}  // namespace tern
