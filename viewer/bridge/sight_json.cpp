#include <algorithm>
#include <cmath>

#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// A cell that no sensor has seen for this long is unseen.
constexpr Duration kSeenLately{1'000'000};
/// A cell of a picture within whose range nothing was, and one of which a part was not measured.
constexpr std::int64_t kFar = -1, kBlind = 0;

/// Returns a depth in decimetres, at least 1; or kFar, or kBlind.
std::int64_t decimetres(std::int16_t depth, double unit_m) {
  if (depth == kFarDepth) return kFar;
  if (depth == kBlindDepth) return kBlind;
  return std::max<std::int64_t>(1, std::llround(10.0 * depth * unit_m));
}

void write_picture(JsonWriter& json, const SensorView& view) {
  json.key("kind").text(view.kind == ViewKind::Pinhole ? "camera" : "lidar");
  json.key("p").vec3(view.sensor_position).key("q").begin_list();
  for (const double x : view.q_WC) json.number(x);
  json.end_list().key("left").number(view.left).key("right").number(view.right);
  json.key("up").number(view.up).key("down").number(view.down).key("range").number(view.range_m);
  json.key("rows").integer(view.rows).key("columns").integer(view.columns).key("depths").begin_list();
  for (const std::int16_t depth : view.depths) json.integer(decimetres(depth, view.unit_m));
  json.end_list();
}

void write_boxes(JsonWriter& json, const SightingSet& set) {
  json.key("lower").begin_list();
  for (const Sighting& s : set.sightings) json.point(s.lower);
  json.end_list().key("upper").begin_list();
  for (const Sighting& s : set.sightings) json.point(s.upper);
  json.end_list().key("bounds").begin_list();
  for (const Sighting& s : set.sightings) {
    for (const BoundSight bound : s.bounds) json.integer(static_cast<std::int64_t>(bound));
  }
  json.end_list();
}

/// Writes the unseen cells about the vehicle; nothing before its first state.
void write_unseen(JsonWriter& json, const Scene& scene) {
  if (!scene.state()) return;
  json.key("unseen").begin_object().key("cell").number(SeenCells::kCell).key("runs").begin_list();
  for (const auto& [x, y, count] : scene.seen().unseen(scene.state()->motion.p, scene.state()->at - kSeenLately)) {
    json.integer(x).integer(y).integer(count);
  }
  json.end_list().end_object();
}

}  // namespace

std::string sight_json(const Scene& scene) {
  if (scene.sightings().empty()) return "null";
  UTime at{};
  for (const auto& [sensor, set] : scene.sightings()) at = std::max(at, set.at);
  if (scene.state()) at = scene.state()->at;
  JsonWriter json;
  json.begin_object().key("at_us").integer(at.us).key("sensors").begin_list();
  for (const auto& [sensor, set] : scene.sightings()) {
    json.begin_object().key("sensor").integer(sensor).key("at_us").integer(set.at.us);
    write_picture(json, set.view);
    write_boxes(json, set);
    json.end_object();
  }
  json.end_list();
  write_unseen(json, scene);
  return json.end_object().take();
}

}  // namespace tern
