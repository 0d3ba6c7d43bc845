#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/world/heading.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// A frame that is older than this relative to the newest one is no longer shown.
constexpr Duration kViewAge{500'000};
/// Fields of view are drawn up to this depth, m.
constexpr double kDrawnRange = 10.0;
/// Lines per edge of an outline.
constexpr int kEdgeLines = 16;
/// Points of the heading per interval of the plan.
constexpr int kYawsPerInterval = 2;

/// Where the ray of this azimuth and elevation ends, W.
Vec3 end_of_ray(const SensorView& view, double azimuth, double elevation) {
  const double depth = std::min(view.range_m, kDrawnRange);
  const Vec3 pinhole(std::tan(azimuth), -std::tan(elevation), 1.0);
  const Vec3 spherical(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                       std::cos(elevation) * std::cos(azimuth));
  const Vec3 ray = depth * (view.kind == ViewKind::Pinhole ? pinhole : spherical);
  const Eigen::Quaterniond q_WC(view.q_WC[0], view.q_WC[1], view.q_WC[2], view.q_WC[3]);
  return view.sensor_position + q_WC * ray;
}

/// The edges at the far side, and between them and the sensor unless it sees all around.
void write_outline(JsonWriter& json, const SensorView& view) {
  const bool sees_all_around = view.left + view.right > 2.0 * std::numbers::pi - 1e-3;
  json.begin_list();
  for (const double elevation : {view.up, -view.down}) {
    const auto at = [&](int k) {
      return end_of_ray(view, -view.left + (view.left + view.right) * k / kEdgeLines, elevation);
    };
    for (int k = 0; k < kEdgeLines; ++k) json.point(at(k)).point(at(k + 1));
    if (sees_all_around) continue;
    for (const int side : {0, kEdgeLines}) json.point(view.sensor_position).point(at(side));
  }
  if (!sees_all_around) {
    for (const double azimuth : {-view.left, view.right}) {
      json.point(end_of_ray(view, azimuth, view.up)).point(end_of_ray(view, azimuth, -view.down));
    }
  }
  json.end_list();
}

/// Writes the yaw along the plan that the heading belongs to; [] if that is not the newest one.
void write_heading(JsonWriter& json, const Scene& scene) {
  json.begin_list();
  const bool is_current = scene.heading() && scene.plan() && scene.plan()->outcome != PlanOutcome::NoPlan &&
                          scene.heading()->request == scene.plan()->inputs.request;
  if (is_current) {
    const HeadingSpline heading(*scene.heading());
    const TimedSpline& trajectory = scene.plan()->trajectory;
    const ClampedSpline spline = trajectory.spline();
    const int points = kYawsPerInterval * spline.intervals();
    for (int k = 0; k <= points; ++k) {
      const UTime t{heading.start().us + (heading.end() - heading.start()).us * k / points};
      const Vec3 p = spline.sample(std::max(0.0, (t - trajectory.start).seconds())).p;
      json.point(p).number(heading.sample(t).yaw);
    }
  }
  json.end_list();
}

}  // namespace

std::string views_json(const Scene& scene) {
  if (!scene.heading() && scene.sightings().empty()) return "null";
  UTime newest{};
  for (const auto& [sensor, set] : scene.sightings()) newest = std::max(newest, set.at);
  JsonWriter json;
  json.begin_object().key("heading");
  write_heading(json, scene);
  json.key("views").begin_list();
  for (const auto& [sensor, set] : scene.sightings()) {
    if (newest - set.at > kViewAge) continue;
    json.begin_object().key("sensor").integer(sensor).key("lines");
    write_outline(json, set.view);
    json.end_object();
  }
  return json.end_list().end_object().take();
}

}  // namespace tern
