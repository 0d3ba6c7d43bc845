#include "viewer/bridge/scene_json.h"

#include "core/drawing/plane_place.h"
#include "core/drawing/predicted_hulls.h"
#include "core/world/names.h"
#include "viewer/bridge/json_writer.h"

namespace tern {
namespace {

/// Points per interval of a drawn curve.
constexpr int kCurveSamples = 8;
constexpr char kNothing[] = "null";

/// Writes [x, y, z, speed, …] along the trajectory.
void write_curve(JsonWriter& json, const TimedSpline& trajectory) {
  const ClampedSpline spline = trajectory.spline();
  const int samples = spline.intervals() * kCurveSamples;
  json.begin_list();
  for (int k = 0; k <= samples; ++k) {
    const MotionSample m = spline.sample(spline.interval_s() * k / kCurveSamples);
    json.point(m.p).number(m.v.norm());
  }
  json.end_list();
}

/// Writes the four MINVO points of each interval.
void write_minvo(JsonWriter& json, const TimedSpline& trajectory) {
  const ClampedSpline spline = trajectory.spline();
  json.begin_list();
  for (int j = 0; j < spline.intervals(); ++j) json.points(spline.minvo(j));
  json.end_list();
}

void write_trajectory(JsonWriter& json, const TimedSpline& trajectory) {
  json.key("start_us").integer(trajectory.start.us).key("interval_us").integer(trajectory.interval.us);
  json.key("curve");
  write_curve(json, trajectory);
  json.key("minvo");
  write_minvo(json, trajectory);
}

void write_planes(JsonWriter& json, const Plan& plan, UTime t_s) {
  json.begin_list();
  for (const CertificatePlane& c : plan.certificate) {
    json.begin_object().key("track").integer(c.track).key("interval").integer(c.interval);
    json.key("part").integer(c.part).key("parts").integer(c.parts);
    json.key("n").vec3(c.plane.n).key("d").number(c.plane.d);
    json.key("at").vec3(place_of(c, plan.trajectory, t_s)).end_object();
  }
  json.end_list();
}

/// Writes a list under a name, with `write` for each element.
template <class T, class Write>
void write_column(JsonWriter& json, const char* name, const std::vector<T>& all, const Write& write) {
  json.key(name).begin_list();
  for (const T& one : all) write(one);
  json.end_list();
}

}  // namespace

std::string state_json(const Scene& scene) {
  if (!scene.state()) return kNothing;
  const UavState& s = *scene.state();
  JsonWriter json;
  json.begin_object().key("at_us").integer(s.at.us).key("p").vec3(s.motion.p).key("v").vec3(s.motion.v);
  json.key("a").vec3(s.motion.a).key("yaw").number(s.yaw);
  if (const auto metres = scene.clearance()) json.key("clearance").number(*metres);
  if (const auto metres = scene.map_clearance()) json.key("map_clearance").number(*metres);
  return json.end_object().take();
}

std::string truth_json(const Scene& scene) {
  if (!scene.truth()) return kNothing;
  const ObstacleTruth& truth = *scene.truth();
  JsonWriter json;
  json.begin_object().key("at_us").integer(truth.at.us).key("left_out").integer(truth.left_out);
  const auto column = [&](const char* name, const auto& write) { write_column(json, name, truth.obstacles, write); };
  column("id", [&](const TrueObstacle& o) { json.integer(o.id); });
  column("moves", [&](const TrueObstacle& o) { json.integer(o.moves ? 1 : 0); });
  column("p", [&](const TrueObstacle& o) { json.point(o.position); });
  column("v", [&](const TrueObstacle& o) { json.point(o.velocity); });
  column("h", [&](const TrueObstacle& o) { json.point(o.half_extents); });
  if (scene.obstacle_names().empty()) return json.end_object().take();
  json.key("names").begin_object();
  for (const TrueObstacle& o : truth.obstacles) {
    const auto name = scene.obstacle_names().find(o.id);
    if (name != scene.obstacle_names().end()) json.key(std::to_string(o.id)).text(name->second);
  }
  json.end_object();
  return json.end_object().take();
}

std::string tracks_json(const Scene& scene) {
  if (!scene.tracks()) return kNothing;
  const TrackSet& set = *scene.tracks();
  JsonWriter json;
  json.begin_object().key("at_us").integer(set.made_at.us).key("left_out").integer(set.left_out);
  json.key("confidence").number(set.confidence);
  const auto column = [&](const char* name, const auto& write) { write_column(json, name, set.tracks, write); };
  column("id", [&](const Track& t) { json.integer(t.id); });
  column("moves", [&](const Track& t) { json.integer(t.kind == TrackKind::Static ? 0 : 1); });
  column("p", [&](const Track& t) { json.point(t.motion.sample(set.made_at).p); });
  column("v", [&](const Track& t) { json.point(t.motion.sample(set.made_at).v); });
  column("h", [&](const Track& t) { json.point(t.half_extents); });
  return json.end_object().take();
}

std::string request_json(const Scene& scene) {
  if (!scene.request()) return kNothing;
  const HorizonRequest& r = *scene.request();
  JsonWriter json;
  json.begin_object().key("id").integer(r.id).key("t_s_us").integer(r.t_s.us).key("p").vec3(r.start.p);
  json.key("v_max").vec3(r.limits.v_max).key("a_max").vec3(r.limits.a_max);
  json.key("radius").number(r.body.radius).key("half").vec3(r.body.half_extents());
  json.key("tube").vec3(r.tube);
  json.key("box").begin_list().point(r.flight_box.min()).point(r.flight_box.max()).end_list();
  write_trajectory(json, r.committed);
  return json.end_object().take();
}

std::string plan_json(const Scene& scene, bool planes) {
  if (!scene.plan()) return kNothing;
  const Plan& plan = *scene.plan();
  JsonWriter json;
  json.begin_object().key("request").integer(plan.request_id).key("outcome").text(to_string(plan.outcome));
  json.key("reason").text(to_string(plan.reason)).key("hold_s").number(plan.hold.seconds());
  json.key("confidence").number(plan.confidence).key("relaxed").flag(plan.relaxed);
  if (plan.sure_for < kMaxSpan) json.key("sure_for_s").number(plan.sure_for.seconds());
  json.key("local_goal").vec3(plan.local_goal);
  json.key("radius").number(plan.sphere_radius).key("cost").number(plan.cost.total);
  json.key("certificate").integer(static_cast<std::int64_t>(plan.certificate.size()));
  if (plan.outcome != PlanOutcome::NoPlan) write_trajectory(json, plan.trajectory);
  // The planes of KeepCommitted are placed by the request's t_s; without the request, by the plan's start.
  const bool has_request = scene.request() && scene.request()->id == plan.request_id;
  if (planes && plan.outcome != PlanOutcome::NoPlan) {
    json.key("planes");
    write_planes(json, plan, has_request ? scene.request()->t_s : plan.trajectory.start);
  }
  return json.end_object().take();
}

std::string timing_json(const Scene& scene) {
  if (!scene.timing()) return kNothing;
  const PlanTiming& t = *scene.timing();
  JsonWriter json;
  json.begin_object().key("request").integer(t.request_id).key("total_ms").number(t.total_ms);
  json.key("allowed_ms").number(scene.allowed_system_ms()).key("first_answer_ms").number(t.first_answer_ms);
  json.key("stage_ms").begin_list();
  for (const double ms : t.stage_ms) json.number(ms);
  json.end_list().key("expansions").integer(t.expansions).key("hulls").integer(t.hulls);
  json.key("watchdog").flag(t.from_watchdog).key("late").flag(scene.is_late());
  return json.end_object().take();
}

std::string hulls_json(const Scene& scene, Duration ahead, double reach, int most) {
  if (!scene.tracks() || !scene.plan() || scene.plan()->outcome == PlanOutcome::NoPlan) return kNothing;
  const PredictedHulls made = predicted_hulls(*scene.tracks(), scene.plan()->trajectory, ahead, reach, most);
  JsonWriter json;
  json.begin_object().key("left_out").integer(made.left_out).key("hulls").begin_list();
  for (const PredictedHull& hull : made.hulls) {
    json.begin_object().key("track").integer(hull.track).key("interval").integer(hull.interval);
    json.key("points").begin_list().points(hull.points).end_list().end_object();
  }
  return json.end_list().end_object().take();
}

std::string search_json(const Scene& scene) {
  if (!scene.search()) return kNothing;
  const std::vector<SearchViewNode>& nodes = scene.search()->nodes;
  JsonWriter json;
  json.begin_object().key("nodes").integer(static_cast<std::int64_t>(nodes.size()));
  json.key("left_out").integer(scene.search()->left_out).key("edges").begin_list();
  for (const SearchViewNode& node : nodes) {
    if (node.parent >= 0) json.point(nodes[idx(node.parent)].position).point(node.position);
  }
  return json.end_list().end_object().take();
}

std::string map_json(const Scene& scene) {
  if (!scene.map()) return kNothing;
  const DrawnMap& map = *scene.map();
  JsonWriter json;
  json.begin_object().key("origin").vec3(map.surface.grid.origin);
  json.key("resolution").number(map.surface.grid.resolution).key("faces").begin_list();
  for (const VoxelFace& face : map.surface.faces) {
    json.integer(static_cast<std::int64_t>(face.label)).integer(face.direction);
    for (int axis = 0; axis < 3; ++axis) json.integer(face.low[axis]);
    for (int axis = 0; axis < 3; ++axis) json.integer(face.high[axis]);
  }
  return json.end_list().end_object().take();
}

std::string health_json(const Scene& scene, UTime now) {
  JsonWriter json;
  json.begin_list();
  for (const auto& [name, process] : scene.processes()) {
    std::int64_t received = 0, refused = 0, lost = 0;
    for (const auto& [channel, c] : process.heartbeat.channels) {
      received += c.received;
      lost += c.lost;
      for (const std::int64_t n : c.rejected) refused += n;
    }
    json.begin_object().key("name").text(name).key("state").text(to_string(process.heartbeat.state));
    json.key("waiting_for").text(process.heartbeat.waiting_for);
    json.key("age_s").number((now - process.received).seconds()).key("received").integer(received);
    json.key("refused").integer(refused).key("lost").integer(lost).end_object();
  }
  return json.end_list().take();
}

std::string goal_json(const Scene& scene) {
  if (!scene.goal()) return kNothing;
  const Goal& goal = *scene.goal();
  JsonWriter json;
  json.begin_object().key("id").integer(goal.id).key("mode").text(to_string(goal.mode));
  if (goal.mode == GoalMode::Go) json.key("p").vec3(goal.position);  ///< other modes have no position
  return json.end_object().take();
}

std::string result_json(const Scene& scene) {
  if (!scene.result()) return kNothing;
  const FlightResult& result = *scene.result();
  JsonWriter json;
  json.begin_object().key("outcome").text(to_string(result.outcome)).key("detail").text(result.detail);
  json.key("flight_time_s").number(result.flight_time_s).key("path_length_m").number(result.path_length_m);
  json.key("top_speed_mps").number(result.top_speed_mps).key("min_clearance_m").number(result.min_clearance_m);
  json.key("min_map_clearance_m").number(result.min_map_clearance_m);
  return json.end_object().take();
}

}  // namespace tern
