#include "tests/viewer/known_log.h"

#include <map>
#include <type_traits>

#include "flight_log/log_writer.h"
#include "messages/codec.h"
#include "tests/viewer/known_scene.h"

namespace tern::support {
namespace {

class Recorder {
 public:
  explicit Recorder(const std::string& path) : writer_(std::move(*LogWriter::open(path, 0))) {}
  template <class T>
  void publish(const Channel<T>& channel, std::type_identity_t<T> message, UTime now) {
    message.header = {{kKnownLogStart.us, ++sequences_[channel.name]}, now};
    writer_.append(channel.name, now.us, encode(message));
  }

 private:
  LogWriter writer_;
  std::map<std::string, std::int64_t> sequences_;
};

}  // namespace

void write_known_log(const std::string& path, Duration lead, double course, Duration sighted) {
  Recorder recorder(path);
  const KnownScene scene(kKnownLogStart, course);
  if (lead > Duration{}) recorder.publish(channels::kHeartbeat, scene.heartbeat(), kKnownLogStart - lead);
  std::int64_t requests = 0;
  for (int tick = 0; tick <= 2'000; ++tick) {
    const UTime now = kKnownLogStart + Duration{tick * 10'000};
    recorder.publish(channels::kUavState, scene.state(now), now);
    if (tick % 5 == 0) {
      recorder.publish(channels::kObstacleTruth, scene.truth(now), now);
      recorder.publish(channels::kObstacleObservations, scene.observations(now), now);
      recorder.publish(channels::kPredictions, scene.predictions(now), now);
    }
    if (tick % 10 == 0) {
      if (now - kKnownLogStart < sighted) recorder.publish(channels::kObstacleSightings, scene.sightings(now), now);
      const HorizonRequest request = scene.request(now, ++requests);
      recorder.publish(channels::kHorizonRequest, request, now);
      recorder.publish(channels::kPlan, scene.plan(request), now);
      recorder.publish(channels::kPlanTiming, scene.timing(request.id), now);
    }
    if (tick % 50 == 0) recorder.publish(channels::kHeartbeat, scene.heartbeat(), now);
    if (tick % 100 == 0) {
      recorder.publish(channels::kGoal, scene.goal(), now);
      recorder.publish(channels::kConfiguration, scene.configuration(), now);
      for (const MapChunk& chunk : to_chunks(scene.map())) recorder.publish(channels::kSemanticMap, chunk, now);
    }
  }
}

}  // namespace tern::support
