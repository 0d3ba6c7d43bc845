#include "predictor/tracking/prediction_log.h"

#include <algorithm>

#include "predictor/models/axis_filter.h"

namespace tern {
namespace {

// Predictions of a new track are stored at these of its detections, and once when it is no longer young; then once in
// kScorePeriod.
constexpr std::array kFirstStored{1, 2, 3, 5, 8};

}  // namespace

TrackRecord& PredictionLog::add_detection(const DetectedTrack& track, UTime at) {
  TrackRecord& record = records_[track.id];
  if (record.detections.empty() || record.born != track.born) {
    record = TrackRecord{};
    record.born = track.born;
  }
  const double gap_s = record.detections.empty() ? 0.0 : (at - record.detections.back().at).seconds();
  record.scores.add_speed(track, at, gap_s);
  record.detections.push_back({at, track.position, track.variance.cwiseMax(kMinVariance)});
  std::erase_if(record.detections,
                [&](const Measurement& s) { return (at - s.at).seconds() > 2.0 * kSmoothingSpan + kMaxGap; });
  return record;
}

bool PredictionLog::is_storing_due(const DetectedTrack& track, UTime at, const TrackRecord& record) {
  if (std::ranges::find(kFirstStored, track.detections) != kFirstStored.end()) return true;
  const bool grew_up = track.age_s(record.last_stored) < kYoungAge && track.age_s(at) >= kYoungAge;
  return grew_up || record.predictions.empty() || (at - record.last_stored).seconds() >= kScorePeriod;
}

StoredPrediction& PredictionLog::store(const DetectedTrack& track, UTime at, TrackRecord& record) {
  record.last_stored = at;
  record.due.push_back(evaluation_time(at, 0));
  StoredPrediction& prediction = record.predictions.emplace_back();
  prediction.at = at;
  prediction.position = track.position;
  return prediction;
}

void PredictionLog::keep_only(const std::set<std::int64_t>& tracks, std::vector<ScoredPrediction>& finished) {
  std::erase_if(records_, [&](const auto& entry) {
    const auto& [id, record] = entry;
    if (tracks.contains(id)) return false;
    for (const StoredPrediction& prediction : record.predictions) finished.push_back(prediction.interval.scored());
    return true;
  });
}

const TrackRecord* PredictionLog::find(std::int64_t id, UTime born) const {
  const auto found = records_.find(id);
  return found == records_.end() || found->second.born != born ? nullptr : &found->second;
}

}  // namespace tern
