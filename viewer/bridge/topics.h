// Makes the JSON of each topic: for a live flight, for a log, or for an exported page.
#pragma once

#include <string>
#include <vector>

#include "viewer/bridge/board.h"
#include "viewer/bridge/commands.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// The inputs of topic_json().
struct TopicSource {
  const Scene& scene;
  const Scene::Memory& memory;
  UTime zero;   ///< the flight's time 0
  UTime until;  ///< end of the past to include
  UTime now;    ///< ages of processes are relative to it
  LayersCommand layers;
  std::vector<std::string> series;
};

/// Returns true for topics about the past. For a log they cover the whole flight and are sent once.
bool is_of_the_past(Topic topic);

/// Returns one JSON value; "null" if nothing was received, and for Session, Player and Ghost, which the scene lacks.
std::string topic_json(Topic topic, const TopicSource& source);

/// Returns another flight's path, {"name", "radius", "t", "curve"}, shifted so that both depart at the same t. Returns
/// "null" until both have departed.
std::string ghost_json(const std::string& name, double radius, const FlightHistory& ghost, const FlightHistory& shown,
                       UTime zero);

}  // namespace tern
