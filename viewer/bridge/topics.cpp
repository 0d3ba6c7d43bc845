#include "viewer/bridge/topics.h"

#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/scene_json.h"

namespace tern {
namespace {

/// Hulls are drawn for the first second of the plan: those of later intervals fill the whole scene of a crowd.
constexpr Duration kHullsAhead{1'000'000};
/// Hulls are drawn for tracks within this distance of the plan, m; at most kMaxHulls (about 10 ms of work).
constexpr double kHullReach = 2.0;
constexpr int kMaxHulls = 240;

std::string path_json(const TopicSource& source) {
  JsonWriter json;
  json.begin_object();
  source.memory.history.write_path(json, source.zero, source.until);
  return json.end_object().take();
}

std::string fields_json(const FlightHistory& history) {
  JsonWriter json;
  json.begin_list();
  for (const std::string& name : history.fields()) json.text(name);
  return json.end_list().take();
}

}  // namespace

bool is_of_the_past(Topic topic) {
  return topic == Topic::Chart || topic == Topic::Path || topic == Topic::Fields || topic == Topic::Events ||
         topic == Topic::Ghost;
}

std::string topic_json(Topic topic, const TopicSource& source) {
  const Scene& scene = source.scene;
  const FlightHistory& history = source.memory.history;
  switch (topic) {
    case Topic::State: return state_json(scene);
    case Topic::Truth: return truth_json(scene);
    case Topic::Tracks: return tracks_json(scene);
    case Topic::Request: return request_json(scene);
    case Topic::Plan: return plan_json(scene, source.layers.planes);
    case Topic::Timing: return timing_json(scene);
    case Topic::Hulls: return hulls_json(scene, kHullsAhead, kHullReach, kMaxHulls);
    case Topic::Tracked: return tracked_json(scene, source.memory.ages);
    case Topic::Search: return search_json(scene);
    case Topic::Views: return views_json(scene);
    case Topic::Estimate: return estimate_json(scene);
    case Topic::Sight: return sight_json(scene);
    case Topic::Map: return map_json(scene);
    case Topic::Health: return health_json(scene, source.now);
    case Topic::Goal: return goal_json(scene);
    case Topic::Result: return result_json(scene);
    case Topic::Chart: return history.chart_json(source.zero, source.until, source.series);
    case Topic::Path: return path_json(source);
    case Topic::Fields: return fields_json(history);
    case Topic::Events: return source.memory.events.json(source.zero);
    case Topic::Session:
    case Topic::Player:
    case Topic::Ghost: break;
  }
  return "null";
}

std::string ghost_json(const std::string& name, double radius, const FlightHistory& ghost, const FlightHistory& shown,
                       UTime zero) {
  const auto its = ghost.departure(), ours = shown.departure();
  if (!its || !ours) return "null";
  JsonWriter json;
  json.begin_object().key("name").text(name).key("radius").number(radius);
  ghost.write_path(json, *its - (*ours - zero), UTime{INT64_MAX});
  return json.end_object().take();
}

}  // namespace tern
