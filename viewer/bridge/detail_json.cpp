#include <fmt/format.h>

#include <algorithm>

#include "core/scenario/obstacle_names.h"
#include "core/world/names.h"
#include "messages/channels.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

// The inspector's view of one picked object: some fields of its newest messages, and values computed from them, such as
// speeds and names of stages. For an obstacle it is everything that is known. tern-export writes all fields of a
// message.

std::string to_text(const MessageName& name) {
  return name.sequence == 0 ? "none" : fmt::format("{} #{}", name.sender_epoch_us, name.sequence);
}

/// Begins {"channel": …, "name": …, "published_us": …}. The caller adds fields and calls end_object().
/// @tparam Writer  JsonWriter for the inspector, NumberWriter for charts
template <class Writer, class T>
Writer& begin_message(Writer& json, const Channel<T>& channel, const T& message) {
  json.begin_object().key("channel").text(channel.name).key("name").text(to_text(message.header.name));
  return json.key("published_us").integer(message.header.utime.us);
}

template <class Writer>
void write_vehicle(Writer& json, const Scene& scene) {
  if (!scene.state()) return;
  const UavState& s = *scene.state();
  begin_message(json, channels::kUavState, s).key("at_us").integer(s.at.us).key("position_m").vec3(s.motion.p);
  json.key("velocity_mps").vec3(s.motion.v).key("acceleration_mps2").vec3(s.motion.a);
  json.key("jerk_mps3").vec3(s.motion.j).key("yaw_rad").number(s.yaw).key("speed_mps").number(s.motion.v.norm());
  json.key("total_acceleration_mps2").number(s.motion.a.norm()).end_object();
}

void write_pieces(JsonWriter& json, const Track& track) {
  json.begin_list();
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    json.begin_object().key("duration_s").number(piece.duration.seconds());
    json.key("from_m").vec3(piece.coefficients.col(3)).key("velocity_mps").vec3(piece.coefficients.col(2));
    json.key("alpha_m").vec3(track.alpha[k]);
    if (!track.shares.empty()) {
      json.key("alpha_shares").begin_list();
      for (const auto& [x, y, z] : track.shares[k]) json.vec3(Vec3(x, y, z));
      json.end_list();
    }
    json.end_object();
  }
  json.end_list();
}

void write_obstacle(JsonWriter& json, const Scene& scene, std::int64_t id) {
  const auto has_id = [id](const auto& entry) { return entry.id == id; };
  if (const auto& truth = scene.truth()) {
    const auto o = std::find_if(truth->obstacles.begin(), truth->obstacles.end(), has_id);
    if (o != truth->obstacles.end()) {
      begin_message(json, channels::kObstacleTruth, *truth).key("id").integer(id).key("at_us").integer(truth->at.us);
      json.key("position_m").vec3(o->position).key("velocity_mps").vec3(o->velocity);
      json.key("half_extents_m").vec3(o->half_extents).key("moves").flag(o->moves).end_object();
    }
  }
  if (const auto& tracks = scene.tracks()) {
    const auto t = std::find_if(tracks->tracks.begin(), tracks->tracks.end(), has_id);
    if (t != tracks->tracks.end()) {
      begin_message(json, channels::kPredictions, *tracks).key("set").integer(tracks->batch.set);
      json.key("id").integer(id).key("kind").text(to_string(t->kind));
      json.key("confidence").number(tracks->confidence).key("half_extents_m").vec3(t->half_extents);
      json.key("top_speed_mps").number(t->top_speed).key("start_us").integer(t->motion.start.us).key("pieces");
      write_pieces(json, *t);
      json.end_object();
    }
  }
}

template <class Writer>
void write_timing(Writer& json, const PlanTiming& t, double allowed_ms) {
  begin_message(json, channels::kPlanTiming, t).key("request").integer(t.request_id).key("total_ms").number(t.total_ms);
  json.key("allowed_ms").number(allowed_ms);
  json.key("first_answer_ms").number(t.first_answer_ms).key("cpu_ms").number(t.cpu_ms);
  for (int k = 0; k < kStages; ++k) json.key(key(static_cast<Stage>(k)) + "_ms").number(t.stage_ms[k]);
  json.key("expansions").integer(t.expansions).key("hulls").integer(t.hulls);
  json.key("pairs_by_box").integer(t.pairs_by_box).key("pairs_by_plane").integer(t.pairs_by_plane);
  json.key("pairs_by_lp").integer(t.pairs_by_lp).key("solver_iterations").integer(t.solver_iterations);
  json.key("peak_rss_kb").integer(t.peak_rss_kb).key("from_watchdog").flag(t.from_watchdog).end_object();
}

template <class Writer>
void write_plan(Writer& json, const Scene& scene) {
  if (!scene.plan()) return;
  const Plan& p = *scene.plan();
  begin_message(json, channels::kPlan, p).key("request").integer(p.request_id);
  json.key("outcome").text(to_string(p.outcome)).key("reason").text(to_string(p.reason));
  json.key("start_us").integer(p.trajectory.start.us).key("interval_s").number(p.trajectory.interval.seconds());
  json.key("intervals").integer(p.trajectory.control_points.cols() - 3).key("hold_s").number(p.hold.seconds());
  json.key("confidence").number(p.confidence).key("alpha_scale").number(p.alpha_scale);
  if (p.sure_for < kMaxSpan) json.key("sure_for_s").number(p.sure_for.seconds());
  json.key("relaxed").flag(p.relaxed).key("local_goal_m").vec3(p.local_goal);
  json.key("sphere_radius_m").number(p.sphere_radius).key("cost_total").number(p.cost.total);
  json.key("cost_distance_to_goal_m").number(p.cost.distance_to_goal).key("cost_jerk").number(p.cost.jerk);
  json.key("cost_attraction").number(p.cost.attraction).key("cost_repulsion").number(p.cost.repulsion);
  json.key("from_request").text(to_text(p.inputs.request)).key("from_goal").text(to_text(p.inputs.goal));
  json.key("from_predictions").text(to_text(p.inputs.predictions)).key("left_out").integer(p.inputs.left_out);
  json.key("map_version").text(fmt::format("{:016x}", p.inputs.map_version));
  json.key("configuration").text(fmt::format("{:016x}", p.inputs.configuration_hash));
  json.key("planes").integer(static_cast<std::int64_t>(p.certificate.size()));
  json.key("budget_cuts").integer(static_cast<std::int64_t>(p.cuts.size())).end_object();
  if (scene.timing()) write_timing(json, *scene.timing(), scene.allowed_system_ms());
}

void write_request(JsonWriter& json, const Scene& scene) {
  if (!scene.request()) return;
  const HorizonRequest& r = *scene.request();
  begin_message(json, channels::kHorizonRequest, r).key("id").integer(r.id).key("t_s_us").integer(r.t_s.us);
  json.key("deadline_us").integer(r.deadline.us).key("start_m").vec3(r.start.p).key("start_mps").vec3(r.start.v);
  json.key("v_max_mps").vec3(r.limits.v_max).key("a_max_mps2").vec3(r.limits.a_max);
  json.key("j_max_mps3").vec3(r.limits.j_max).key("body_radius_m").number(r.body.radius);
  json.key("flight_box_min_m").vec3(r.flight_box.min()).key("flight_box_max_m").vec3(r.flight_box.max()).end_object();
}

void write_goal(JsonWriter& json, const Scene& scene) {
  if (!scene.goal()) return;
  begin_message(json, channels::kGoal, *scene.goal()).key("goal").raw(goal_json(scene)).end_object();
}

void write_map(JsonWriter& json, const Scene& scene) {
  if (!scene.map()) return;
  const DrawnMap& map = *scene.map();
  json.begin_object()
      .key("channel")
      .text(channels::kSemanticMap.name)
      .key("version")
      .text(fmt::format("{:016x}", map.version));
  json.key("origin_m").vec3(map.grid.origin).key("resolution_m").number(map.grid.resolution).key("size");
  json.begin_list().integer(map.grid.size.x()).integer(map.grid.size.y()).integer(map.grid.size.z()).end_list();
  for (std::size_t k = 0; k < kVoxelLabels; ++k) json.key(kWords<VoxelLabel>[k]).integer(map.voxels[k]);
  json.key("classes").begin_list();
  for (const std::string& name : map.class_names) json.text(name);
  json.end_list().end_object();
}

void write_process(JsonWriter& json, const Scene& scene, const std::string& name) {
  const auto found = scene.processes().find(name);
  if (found == scene.processes().end()) return;
  const Heartbeat& h = found->second.heartbeat;
  begin_message(json, channels::kHeartbeat, h).key("build").text(h.build_id).key("state").text(to_string(h.state));
  json.key("waiting_for").text(h.waiting_for).key("channels").begin_object();
  for (const auto& [channel, c] : h.channels) {
    std::int64_t refused = 0;
    for (const std::int64_t n : c.rejected) refused += n;
    json.key(channel).text(
        fmt::format("sent {}, received {}, refused {}, lost {}, late {}", c.sent, c.received, refused, c.lost, c.late));
  }
  json.end_object().end_object();
  if (const auto& report = found->second.configuration) {
    begin_message(json, channels::kConfiguration, *report).key("hash").text(fmt::format("{:016x}", report->hash));
    json.key("yaml").text(report->yaml).end_object();
  }
}

void write_result(JsonWriter& json, const Scene& scene) {
  if (!scene.result()) return;
  begin_message(json, channels::kFlightResult, *scene.result()).key("result").raw(result_json(scene)).end_object();
}

std::string title_of(const PickCommand& pick, const Scene& scene) {
  switch (pick.kind) {
    case PickKind::Vehicle: return "Vehicle";
    case PickKind::Obstacle: return "Obstacle " + with_name(pick.id, scene.obstacle_names());
    case PickKind::Plan: return "Plan";
    case PickKind::Request: return "Committed trajectory";
    case PickKind::Goal: return "Goal";
    case PickKind::Map: return "Semantic map";
    case PickKind::Process: return pick.name;
    case PickKind::Result: return "Flight result";
  }
  return "";
}

}  // namespace

std::string detail_json(const Scene& scene, const PickCommand& pick) {
  JsonWriter json;
  json.begin_object().key("title").text(title_of(pick, scene));
  const auto clearance = pick.kind == PickKind::Obstacle ? scene.clearance_of(pick.id) : std::nullopt;
  if (clearance) json.key("clearance_m").number(*clearance);
  json.key("messages").begin_list();
  switch (pick.kind) {
    case PickKind::Vehicle: write_vehicle(json, scene); break;
    case PickKind::Obstacle: write_obstacle(json, scene, pick.id); break;
    case PickKind::Plan: write_plan(json, scene); break;
    case PickKind::Request: write_request(json, scene); break;
    case PickKind::Goal: write_goal(json, scene); break;
    case PickKind::Map: write_map(json, scene); break;
    case PickKind::Process: write_process(json, scene, pick.name); break;
    case PickKind::Result: write_result(json, scene); break;
  }
  return json.end_list().end_object().take();
}

NumberFields vehicle_numbers(const Scene& scene) {
  NumberWriter numbers;
  write_vehicle(numbers, scene);
  return numbers.take();
}

NumberFields plan_numbers(const Scene& scene) {
  NumberWriter numbers;
  write_plan(numbers, scene);
  return numbers.take();
}

}  // namespace tern
