#include <algorithm>
#include <limits>

#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// Older detections are no longer shown.
constexpr Duration kDetectionAge{500'000};

template <class T, class Write>
void write_column(JsonWriter& json, const char* name, const std::vector<T>& all, const Write& write) {
  json.key(name).begin_list();
  for (const T& one : all) write(one);
  json.end_list();
}

std::vector<Detection> newest_detections(const Scene& scene) {
  std::vector<Detection> all;
  UTime newest{};
  for (const auto& [sensor, set] : scene.detections()) newest = std::max(newest, set.at);
  for (const auto& [sensor, set] : scene.detections()) {
    if (newest - set.at <= kDetectionAge) all.insert(all.end(), set.detections.begin(), set.detections.end());
  }
  return all;
}

std::vector<Track> moving_tracks(const TrackSet& set) {
  std::vector<Track> moving;
  std::ranges::copy_if(set.tracks, std::back_inserter(moving),
                       [](const Track& t) { return t.kind != TrackKind::Static; });
  return moving;
}

}  // namespace

std::string tracked_json(const Scene& scene, const TrackAges& ages) {
  if (!scene.tracks() && scene.detections().empty()) return "null";
  JsonWriter json;
  const std::vector<Detection> detections = newest_detections(scene);
  json.begin_object().key("detections").begin_object();
  write_column(json, "id", detections, [&](const Detection& d) { json.integer(d.track_id); });
  write_column(json, "p", detections, [&](const Detection& d) { json.point(d.position); });
  write_column(json, "h", detections, [&](const Detection& d) { json.point(d.half_extents); });
  json.end_object();
  if (!scene.tracks()) return json.end_object().take();
  const UTime at = scene.tracks()->made_at;
  const std::vector<Track> tracks = moving_tracks(*scene.tracks());
  json.key("tracks").begin_object().key("at_us").integer(at.us);
  const auto column = [&](const char* name, const auto& write) { write_column(json, name, tracks, write); };
  column("id", [&](const Track& t) { json.integer(t.id); });
  column("age_s",
         [&](const Track& t) { json.number(ages.age_s(t.id, at).value_or(std::numeric_limits<double>::quiet_NaN())); });
  column("p", [&](const Track& t) { json.point(t.motion.sample(at).p); });
  column("v", [&](const Track& t) { json.point(t.motion.sample(at).v); });
  column("h", [&](const Track& t) { json.point(t.half_extents); });
  // A prediction begins later than its newest input, by the sensor's latency. Before its first piece the box only
  // grows.
  column("alpha", [&](const Track& t) {
    const UTime begin = std::max(at, t.motion.start);
    json.point(0.5 * t.bounds(begin, begin).sizes() - t.half_extents);
  });
  return json.end_object().end_object().take();
}

}  // namespace tern
