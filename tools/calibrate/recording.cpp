#include "tools/calibrate/recording.h"

#include <iterator>

#include "flight_log/flight_log.h"
#include "messages/channels.h"

namespace tern::calibrate {

std::optional<Vec3> TruePath::at(UTime t) const {
  const auto after = centres.lower_bound(t);
  if (after == centres.end()) return std::nullopt;
  if (after->first == t) return after->second;
  if (after == centres.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap = (after->first - before->first).seconds();
  if (gap > kTruthGap) return std::nullopt;
  const double u = (t - before->first).seconds() / gap;
  return Vec3((1.0 - u) * before->second + u * after->second);
}

Result<Recording> read_recording(const std::string& path) {
  Recording recording;
  recording.name = path;
  FlightLog log;
  log.on(channels::kObstacleObservations, [&](const ObservationSet& set, std::int64_t received_us) {
    recording.observations.push_back({UTime{received_us}, set});
  });
  log.on(channels::kObstacleTruth, [&](const ObstacleTruth& truth, std::int64_t) {
    for (const TrueObstacle& obstacle : truth.obstacles) {
      TruePath& path_of = recording.truth[obstacle.id];
      path_of.half_extents = obstacle.half_extents;
      path_of.centres[truth.at] = obstacle.position;
    }
  });
  const auto contents = log.read(path);
  if (!contents) return tl::make_unexpected(contents.error());
  if (recording.observations.empty()) return fail(path + ": holds no OBSTACLE_OBSERVATIONS");
  return recording;
}

}  // namespace tern::calibrate
