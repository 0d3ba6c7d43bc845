#include "predictor/app/predictor_node.h"

#include <algorithm>
#include <utility>

#include "messages/batching.h"
#include "predictor/models/declared.h"
#include "predictor/tracking/priority.h"
#include "runtime/channels.h"

namespace tern {

PredictorNode::PredictorNode(Bus& bus, const PredictorConfig& config)
    : bus_(bus), config_(config), tracker_(config.tracker) {
  if (config_.model != PredictorModel::ConstantVelocity) {
    bus_.subscribe<TrackSet>(channels::kDeclaredMotions, [this](const TrackSet& batch) { on_declared(batch); });
  }
  if (config_.model != PredictorModel::Declared) {
    bus_.subscribe<ObservationSet>(channels::kObstacleObservations,
                                   [this](const ObservationSet& observations) { on_observations(observations); });
  }
  bus_.subscribe<UavState>(channels::kUavState, [this](const UavState& state) { vehicle_ = state.motion.p; });
}

void PredictorNode::on_declared(const TrackSet& batch) {
  auto batches = collector_.add(batch);
  if (!batches) return;
  TrackSet declared = join_batches(std::move(*batches));
  declared_ = std::move(declared.tracks);
  have_input(declared.made_at);
}

void PredictorNode::on_observations(const ObservationSet& observations) {
  if (tracker_.update(without_explained(observations, declared_)) != Taken::Yes) {
    return bus_.count_late(channels::kObstacleObservations);
  }
  have_input(observations.at);
}

void PredictorNode::have_input(UTime made_at) {
  if (!made_at_) next_ = bus_.clock().now();
  made_at_ = made_at_ ? std::max(*made_at_, made_at) : made_at;
}

void PredictorNode::step(UTime now) {
  if (now < next_) return;
  publish(now);
  next_ = next_ + config_.period;
  if (next_ <= now) next_ = now + config_.period;  // what was missed is not made up for
}

std::vector<Track> PredictorNode::predictions(UTime now) const {
  const Duration horizon = config_.tracker.prediction.horizon;
  return merged(trimmed(declared_, now, horizon), tracker_.predict(now), now);
}

void PredictorNode::publish(UTime now) {
  TrackSet set;
  set.batch.set = ++sets_;
  set.made_at = *made_at_;
  set.tracks = predictions(now);
  const bool estimated = std::any_of(set.tracks.begin(), set.tracks.end(),
                                     [](const Track& track) { return track.kind == TrackKind::Estimated; });
  set.confidence = estimated ? config_.tracker.prediction.confidence : 1.0;
  if (vehicle_) sort_by_reach(set.tracks, *vehicle_, now, config_.tracker.prediction.horizon);
  bus_.publish_paced(channels::kPredictions, split_batches(set));
}

NodeHealth PredictorNode::health() const {
  if (!made_at_ || bus_.clock().now() - *made_at_ > kInputsStopped) {
    return {ProcessState::Waiting, "obstacle observations or declared motions"};
  }
  return {ProcessState::Ready, ""};
}

}  // namespace tern
