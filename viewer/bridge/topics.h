// What the page is told on each topic: of a live flight, of a log, or into a file.
#pragma once

#include <string>
#include <vector>

#include "viewer/bridge/board.h"
#include "viewer/bridge/commands.h"
#include "viewer/bridge/scene.h"

namespace tern {

struct TopicSource {
  const Scene& scene;
  const Scene::Memory& memory;
  UTime zero;   ///< the flight's time 0
  UTime until;  ///< as far as its past is told
  UTime now;    ///< ages of processes are counted to it
  LayersCommand layers;
  std::vector<std::string> series;
};

/// Of a log these are of the whole flight, told once.
bool is_of_the_past(Topic topic);

/// One JSON value; "null" where nothing was heard, and for topics that are not of the scene (Session, Player, Ghost).
std::string topic_json(Topic topic, const TopicSource& source);

/// Another flight's path over this one: {"name", "radius", "t", "curve"}, both departing at the same t. "null" while
/// one of them has not departed.
std::string ghost_json(const std::string& name, double radius, const FlightHistory& ghost, const FlightHistory& shown,
                       UTime zero);

}  // namespace tern
