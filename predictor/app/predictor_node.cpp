#include "predictor/app/predictor_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/names.h"
#include "core/world/track_order.h"
#include "messages/batching.h"
#include "messages/channels.h"
#include "messages/codec.h"
#include "messages/refused_field.h"
#include "predictor/models/declared.h"
#include "predictor/tracking/usable.h"

namespace tern {
namespace {

constexpr const char* kDeclaredInput = "declared motions";

}  // namespace

PredictorNode::PredictorNode(Bus& bus, const PredictorConfig& config)
    : bus_(bus), config_(config), tracker_(config.tracker) {
  if (config_.model != PredictorModel::Detections) {
    bus_.subscribe(channels::kDeclaredMotions, [this](const TrackSet& batch) { on_declared(batch); });
  }
  if (config_.model != PredictorModel::Declared) {
    bus_.subscribe(channels::kObstacleObservations, [this](const ObservationSet& set) { on_frame({set}); });
    bus_.subscribe(channels::kObstacleSightings, [this](const SightingSet& set) { on_frame({set}); });
  }
  bus_.subscribe(channels::kUavState, [this](const UavState& state) {
    vehicle_ = state.motion.p;
    world_error_.add_vehicle(state.motion.p, state.at);
  });
  bus_.subscribe(channels::kOdometry, [this](const Odometry& odometry) { world_error_.add(odometry); });
}

void PredictorNode::on_declared(const TrackSet& batch) {
  auto batches = collector_.add(batch);
  if (!batches) return;
  TrackSet declared = join_batches(std::move(*batches));
  declared_ = std::move(declared.tracks);
  declared_left_out_ = declared.left_out;
  have_input(kDeclaredInput, declared.made_at);
}

void PredictorNode::on_frame(SensorFrame frame) {
  const UTime now = bus_.clock().now();
  const std::string refusal = senders_.refusal(frame.sensor_id(), frame.header().name.sender_epoch_us, now);
  if (!refusal.empty()) {
    frame.count_late(bus_);
    return watch_.trouble("senders", frame.input_name() + ": " + refusal, now);
  }
  if (frame.at() + kMaxAge < now) {
    frame.count_late(bus_);
    return watch_.trouble("age",
                          fmt::format("{}: measured {:.0f} s ago, not used (at_us is in µs, by the vehicle's clock)",
                                      frame.input_name(), (now - frame.at()).seconds()),
                          now);
  }
  frame.remove_explained(declared_);
  if (waiting_.size() >= kMaxWaitingSets) {
    skip(waiting_.front().frame, now);
    waiting_.pop_front();
  }
  waiting_.push_back({std::move(frame), bus_.received()});
}

void PredictorNode::skip(const SensorFrame& frame, UTime now) {
  frame.count_late(bus_);
  watch_.trouble("overloaded", frame.input_name() + ": overloaded, sets are skipped for newer ones", now);
}

void PredictorNode::use_waiting() {
  const UTime begun = bus_.clock().now();
  for (UTime now = begun; !waiting_.empty() && now - begun <= kMaxWorkPerStep; now = bus_.clock().now()) {
    Waiting oldest = std::move(waiting_.front());
    waiting_.pop_front();
    const SensorFrame& frame = oldest.frame;
    const bool is_replaced = std::ranges::any_of(waiting_, [&](const Waiting& other) {
      return other.frame.sensor_id() == frame.sensor_id() && other.frame.at() > frame.at();
    });
    if (now - oldest.arrived > kMaxWait && is_replaced) {
      skip(frame, now);
    } else {
      use(std::move(oldest.frame));
    }
  }
}

void PredictorNode::use(SensorFrame frame) {
  const UTime now = bus_.clock().now();
  const std::string input = frame.input_name();
  if (const std::size_t unusable = frame.remove_unusable(); unusable > 0) {
    const std::string text = fmt::format("{}: {} detections with a standard deviation above {} m are not used", input,
                                         unusable, kMaxDeviation);
    watch_.trouble("unusable", text, now);
  }
  if (const std::size_t foreign = frame.remove_foreign_ids(); foreign > 0) {
    watch_.trouble("ids", fmt::format("{}: {} ids from {} on are not used", input, foreign, kFirstOwnTrackId), now);
  }
  const UpdateOutcome outcome = frame.give_to(tracker_, vehicle_);
  if (outcome == UpdateOutcome::Used) {
    if (const std::int32_t left_out = tracker_.left_out(); left_out > 0) {
      watch_.trouble("flood",
                     fmt::format("overloaded: {} new detections, the farthest, are not used; {} sent {} (false ones?)",
                                 left_out, input, frame.size()),
                     now);
    }
    return have_input(input, frame.at());
  }
  frame.count_late(bus_);
  if (outcome == UpdateOutcome::TooCostly) {
    watch_.trouble("overloaded", input + ": overloaded, sets that come out of order are not used", now);
  }
  if (outcome == UpdateOutcome::Repeated) {
    const std::string text = input + ": two sets of one time, the second is not used (do two sensors have one id?)";
    watch_.trouble("repeated", text, now);
  }
}

void PredictorNode::have_input(const std::string& input, UTime made_at) {
  const UTime now = bus_.clock().now();
  watch_.used(input, now);
  if (!made_at_) next_ = now;
  made_at_ = made_at_ ? std::max(*made_at_, made_at) : made_at;
}

void PredictorNode::step(UTime now) {
  if (is_sending()) return;
  use_waiting();
  if (now < next_) return;
  publish(now);
  next_ = next_ + config_.period();
  if (next_ <= now) next_ = now + config_.period();  // missed periods are skipped
}

void PredictorNode::publish_bounds(const TrackSet& set, const std::vector<TrackBound>& bounds, UTime now) {
  next_bounds_ = now + kBoundsPeriod;
  TrackBounds of;
  of.at = now;
  of.confidence = set.confidence;
  for (const Track& track : set.tracks) {
    // An owner may also declare estimated tracks; they have no bounds here.
    const auto bound = std::ranges::lower_bound(bounds, track.id, {}, &TrackBound::id);
    if (track.kind != TrackKind::Estimated || bound == bounds.end() || bound->id != track.id) continue;
    of.at = track.motion.start;  // the same for all; later than now if a sensor's clock is ahead
    if (of.bounds.size() < kMaxTrackBounds) {
      of.bounds.push_back(*bound);
    } else {
      ++of.left_out;
    }
  }
  if (const auto why = refusal(of, now)) return report_unsendable(channels::kTrackBounds.name, *why, now);
  bus_.publish(channels::kTrackBounds, std::move(of));
}

void PredictorNode::publish(UTime now) {
  TrackSet set;
  set.batch.set = ++sets_;
  set.made_at = *made_at_;
  const Duration horizon = config_.tracker.prediction.horizon;
  std::vector<TrackBound> bounds;
  const bool is_bounds_due = now >= next_bounds_;
  std::vector<Track> declared = trimmed(declared_, now, horizon);
  if (world_error_.is_known()) {
    set.pose_error = world_error_.pose_error(now);
    widen(declared, *set.pose_error, now);
  }
  if (world_error_.is_stale(now))
    watch_.trouble("odometry", "no valid ODOMETRY: margins of things known in W grow", now);
  set.tracks = merged(std::move(declared), tracker_.predict(now, is_bounds_due ? &bounds : nullptr), now);
  const bool estimated = std::any_of(set.tracks.begin(), set.tracks.end(),
                                     [](const Track& track) { return track.kind == TrackKind::Estimated; });
  set.confidence = estimated ? config_.tracker.prediction.confidence : 1.0;
  if (set.pose_error) set.confidence = std::min(set.confidence, PoseError::kConfidence);
  if (vehicle_) sort_by_reach(set.tracks, *vehicle_, now, config_.tracker.prediction.horizon);
  const std::int32_t left_out_before = declared_left_out_ + tracker_.left_out();
  set.left_out = left_out_before;
  std::vector<TrackSet> batches = split_batches(set);
  if (declared_left_out_ > 0) {
    watch_.trouble("declared left out",
                   fmt::format("{} declared motions are missing: their owner left them out", declared_left_out_), now);
  }
  if (const std::int32_t left_out = batches.front().left_out - left_out_before; left_out > 0) {
    const std::string text =
        fmt::format("{} of {} tracks do not fit into a set: the farthest are left out", left_out, set.tracks.size());
    watch_.trouble("left out", text, now);
  }
  if (is_bounds_due) publish_bounds(set, bounds, now);
  if (!remove_unsendable(batches, now)) return;
  if (set.pose_error) {
    set.pose_error->set = set.batch.set;
    bus_.publish(channels::kPoseError, *set.pose_error);
  }
  bus_.publish_paced(channels::kPredictions, std::move(batches));
}

template <class T>
std::optional<std::string> PredictorNode::refusal(T message, UTime now) const {
  message.header = {{bus_.epoch_us(), 1}, now};  // the bus writes the real one
  const Bytes bytes = encode(message);
  const auto decoded = decode<T>(bytes);
  if (decoded) return std::nullopt;
  const std::string field = refused_field<T>(bytes);
  return field.empty() ? to_string(decoded.error()) : field;
}

void PredictorNode::report_unsendable(const char* channel, const std::string& why, UTime now) {
  ++unsendable_;
  watch_.trouble(
      channel,
      fmt::format("{}: not sent, since every receiver would refuse it: {} ({} so far)", channel, why, unsendable_),
      now);
}

bool PredictorNode::remove_unsendable(std::vector<TrackSet>& batches, UTime now) {
  std::int32_t removed = 0;
  for (TrackSet& batch : batches) {
    if (!refusal(batch, now)) continue;
    TrackSet alone = batch;
    removed += static_cast<std::int32_t>(std::erase_if(batch.tracks, [&](const Track& track) {
      alone.tracks = {track};
      const auto why = refusal(alone, now);
      if (why) report_unsendable(channels::kPredictions.name, fmt::format("track {}: {}", track.id, *why), now);
      return why.has_value();
    }));
    if (const auto why = refusal(batch, now)) {
      report_unsendable(channels::kPredictions.name, *why, now);
      return false;
    }
  }
  for (TrackSet& batch : batches) batch.left_out += removed;
  return true;
}

NodeHealth PredictorNode::health() const {
  const UTime now = bus_.clock().now();
  std::string text = watch_.silent(now);
  if (!made_at_) {
    text = "obstacle observations or declared motions";
  } else if (text.empty() && now - *made_at_ > kInputsStopped) {
    text = fmt::format("newer inputs (the newest is {:.1f} s old)", (now - *made_at_).seconds());
  }
  const ProcessState state = text.empty() ? ProcessState::Ready : ProcessState::Waiting;
  const std::string troubles = watch_.troubles(now);
  if (!text.empty() && !troubles.empty()) text += "; ";
  return {state, text + troubles};
}

}  // namespace tern
