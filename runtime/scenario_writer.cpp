#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "runtime/scenario_file.h"
#include "runtime/yaml_tree.h"

namespace tern {
namespace {

std::string to_yaml(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", yaml_number(v.x()), yaml_number(v.y()), yaml_number(v.z()));
}

std::string to_yaml(const Box& box) {
  return fmt::format("{{min: {}, max: {}}}", to_yaml(box.min()), to_yaml(box.max()));
}

/// The keys of a motion, one per line; a static one has only its centre.
std::string motion_yaml(const ObstacleSpec& obstacle) {
  const auto line = [](const char* key, const std::string& value) { return fmt::format("      {}: {}\n", key, value); };
  const auto visitor = [&](const auto& motion) -> std::string {
    using Motion = std::decay_t<decltype(motion)>;
    std::string centre = line("centre", to_yaml(obstacle.centre));
    if constexpr (std::is_same_v<Motion, TrefoilMotion>) {
      return centre + line("motion", "trefoil") + line("scale", to_yaml(motion.scale)) +
             line("slowness", yaml_number(motion.slowness)) + line("phase", yaml_number(motion.phase));
    } else if constexpr (std::is_same_v<Motion, WaveMotion>) {
      return centre + line("motion", "wave") + line("amplitude", to_yaml(motion.amplitude)) +
             line("slowness", yaml_number(motion.slowness)) + line("phase", yaml_number(motion.phase));
    } else if constexpr (std::is_same_v<Motion, LinearMotion>) {
      return centre + line("motion", "linear") + line("velocity", to_yaml(motion.velocity)) +
             line("from_s", yaml_number(motion.from_s));
    } else if constexpr (std::is_same_v<Motion, WaypointMotion>) {
      std::string points;
      for (const auto& [t, p] : motion.points) {
        points += fmt::format("{}[{}, {}, {}, {}]", points.empty() ? "" : ", ", yaml_number(t), yaml_number(p.x()),
                              yaml_number(p.y()), yaml_number(p.z()));
      }
      return line("motion", "waypoints") + line("points", "[" + points + "]") +
             line("repeat", motion.repeat ? "true" : "false") + line("vanish", motion.vanish ? "true" : "false") +
             (motion.vanish ? line("leave_out_within_m", yaml_number(motion.leave_out_within_m)) : "");
    } else {
      return centre;
    }
  };
  return std::visit(visitor, obstacle.motion);
}

std::string recorded_yaml(const RecordedTracksSpec& spec) {
  std::string out = fmt::format("    - file: {}\n      columns: {}\n", yaml_text(spec.file), spec.columns);
  out += fmt::format("      id_column: {}\n      frame_column: {}\n", spec.id_column, spec.frame_column);
  out += fmt::format("      x_column: {}\n      y_column: {}\n", spec.x_column, spec.y_column);
  if (spec.z_column) out += fmt::format("      z_column: {}\n", *spec.z_column);
  out += fmt::format("      metres_per_unit: {}\n", yaml_number(spec.metres_per_unit));
  out += fmt::format("      frames_per_second: {}\n", yaml_number(spec.frames_per_second));
  out += fmt::format("      least_step_s: {}\n", yaml_number(spec.least_step_s));
  out += fmt::format("      half_extents: {}\n", to_yaml(spec.half_extents));
  out += fmt::format("      centre_z: {}\n", yaml_number(spec.centre_z));
  if (spec.copies > 0) {
    return out + fmt::format("      copies: {}\n      within: {}\n", spec.copies, to_yaml(spec.within));
  }
  if (spec.start_s) {
    out += fmt::format("      start_s: {}\n", yaml_number(*spec.start_s));
    out += fmt::format("      wait_for_clear_start: {}\n", spec.wait_for_clear_start);
  }
  return out + fmt::format("      leave_out_within_m: {}\n", yaml_number(spec.leave_out_within_m));
}

std::string levels_yaml(double floor, double ceiling) {
  return (std::isfinite(floor) ? fmt::format("      floor: {}\n", yaml_number(floor)) : "") +
         (std::isfinite(ceiling) ? fmt::format("      ceiling: {}\n", yaml_number(ceiling)) : "");
}

std::string shape_yaml(const FencePolygon& polygon, bool is_geodetic) {
  std::string corners;
  for (const Eigen::Vector2d& c : polygon.corners) {
    corners += fmt::format("{}[{}, {}]", corners.empty() ? "" : ", ", yaml_number(c.x()), yaml_number(c.y()));
  }
  return fmt::format("{}: [{}]", is_geodetic ? "coordinates" : "corners", corners);
}

std::string shape_yaml(const FenceCircle& circle, bool is_geodetic) {
  const std::string x = yaml_number(circle.centre.x()), y = yaml_number(circle.centre.y());
  const std::string centre =
      is_geodetic ? fmt::format("latitude: {}, longitude: {}", x, y) : fmt::format("centre: [{}, {}]", x, y);
  return fmt::format("circle: {{{}, radius: {}}}", centre, yaml_number(circle.radius));
}

std::string fences_yaml(const WorldSpec& world) {
  std::string out;
  if (const auto& o = world.origin) {
    out = fmt::format("  origin: {{latitude: {}, longitude: {}, height: {}}}\n", yaml_number(o->latitude),
                      yaml_number(o->longitude), yaml_number(o->height));
  }
  out += world.fences.empty() && world.fence_files.empty() ? "" : "  fences:\n";
  for (const Fence& fence : world.fences) {
    const std::string shape = std::visit([&](const auto& s) { return shape_yaml(s, fence.is_geodetic); }, fence.shape);
    out += fmt::format("    - {}\n      kind: {}\n", shape, fence.is_inclusion ? "inclusion" : "exclusion");
    if (!fence.name.empty()) out += fmt::format("      name: {}\n", yaml_text(fence.name));
    out += levels_yaml(fence.floor, fence.ceiling);
  }
  for (const FenceFile& file : world.fence_files) {
    out += fmt::format("    - file: {}\n", yaml_text(file.file)) + levels_yaml(file.floor, file.ceiling);
  }
  return out;
}

std::string world_yaml(const WorldSpec& world) {
  std::string out = fmt::format("world:\n  generator: {}\n  count: {}\n", world.generator, world.count);
  if (world.slowness) out += fmt::format("  slowness: {}\n", yaml_number(*world.slowness));
  out += world.obstacles.empty() ? "" : "  obstacles:\n";
  for (const ObstacleSpec& obstacle : world.obstacles) {
    out += fmt::format("    - half_extents: {}\n", to_yaml(obstacle.half_extents));
    if (!obstacle.name.empty()) out += fmt::format("      name: {}\n", yaml_text(obstacle.name));
    out += motion_yaml(obstacle);
  }
  out += world.recorded.empty() ? "" : "  recorded:\n";
  for (const RecordedTracksSpec& spec : world.recorded) out += recorded_yaml(spec);
  return out + fences_yaml(world);
}

std::string body_yaml(const Body& body) {
  const bool sphere = body.vertices.cols() == 1 && body.vertices.isZero(0.0);
  if (sphere) return fmt::format("{{radius: {}}}", yaml_number(body.radius));
  std::string vertices;
  for (Eigen::Index k = 0; k < body.vertices.cols(); ++k) {
    vertices += (k == 0 ? "" : ", ") + to_yaml(Vec3(body.vertices.col(k)));
  }
  return fmt::format("{{vertices: [{}]}}", vertices);
}

/// Headings are written only if they differ from the default, since few scenarios plan them.
std::string heading_yaml(const HeadingLimits& heading) {
  if (heading == HeadingLimits{}) return "";
  return fmt::format("  heading: {{rate_max: {}, acceleration_max: {}, view: {}}}\n",
                     yaml_number(heading.rate_max_deg_s), yaml_number(heading.acceleration_max_deg_s2),
                     yaml_number(heading.view_deg));
}

std::string uav_yaml(const UavSpec& uav) {
  std::string dynamics;
  if (const auto& d = uav.limits.dynamics) {
    dynamics = fmt::format("  dynamics: {{thrust_min: {}, thrust_max: {}, tilt_max: {}, body_rate_max: {}}}\n",
                           yaml_number(d->thrust_min), yaml_number(d->thrust_max), yaml_number(d->tilt_max_deg),
                           yaml_number(d->body_rate_max_deg_s));
  }
  return fmt::format("uav:\n  start: {}\n  goal: {}\n", to_yaml(uav.start), to_yaml(uav.goal)) +
         fmt::format("  limits:\n    v_max: {}\n    a_max: {}\n    j_max: {}\n", to_yaml(uav.limits.v_max),
                     to_yaml(uav.limits.a_max), to_yaml(uav.limits.j_max)) +
         dynamics + heading_yaml(uav.heading) +
         fmt::format("  body: {}\n  flight_box: {}\n", body_yaml(uav.body), to_yaml(uav.flight_box));
}

std::string shape_yaml(const Box& box) { return "box: " + to_yaml(box); }

std::string shape_yaml(const BallRegion& ball) {
  return fmt::format("ball: {{centre: {}, radius: {}}}", to_yaml(ball.centre), yaml_number(ball.radius));
}

std::string shape_yaml(const PrismRegion& prism) {
  std::string corners;
  for (const Eigen::Vector2d& c : prism.corners) {
    corners += fmt::format("{}[{}, {}]", corners.empty() ? "" : ", ", yaml_number(c.x()), yaml_number(c.y()));
  }
  return fmt::format("prism: {{corners: [{}], z_min: {}, z_max: {}}}", corners, yaml_number(prism.z_min),
                     yaml_number(prism.z_max));
}

std::string semantics_yaml(const SemanticsSpec& semantics) {
  std::string out = fmt::format(
      "semantics:\n  enabled: {}\n  lambda_attractive: {}\n  lambda_repulsive: {}\n  cost: {}\n", semantics.enabled,
      yaml_number(semantics.lambda_attractive), yaml_number(semantics.lambda_repulsive), semantics.cost);
  out += semantics.classes.empty() ? "  classes: {}\n" : "  classes:\n";
  for (const auto& [name, label] : semantics.classes) out += fmt::format("    {}: {}\n", yaml_text(name), label);
  out += semantics.lambdas.empty() ? "" : "  lambdas:\n";
  for (const auto& [name, lambda] : semantics.lambdas) {
    out += fmt::format("    {}: {}\n", yaml_text(name), yaml_number(lambda));
  }
  out += semantics.regions.empty() ? "" : "  regions:\n";
  for (const Region& region : semantics.regions) {
    const std::string shape = std::visit([](const auto& s) { return shape_yaml(s); }, region.shape);
    out += fmt::format("    - name: {}\n      class: {}\n      {}\n", yaml_text(region.name),
                       yaml_text(region.class_name), shape);
  }
  return out;
}

}  // namespace

std::string write_scenario(const Scenario& scenario) {
  std::string out = fmt::format("name: {}\nseed: {}\n", yaml_text(scenario.name), scenario.seed);
  if (scenario.timeout_s) out += fmt::format("timeout_s: {}\n", yaml_number(*scenario.timeout_s));
  return out + world_yaml(scenario.world) + uav_yaml(scenario.uav) + semantics_yaml(scenario.semantics);
}

}  // namespace tern
