// The scene in the words of the page: one JSON value per topic. "null" where nothing was heard.
#pragma once

#include <string>

#include "viewer/bridge/commands.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// Flat lists, one number after the other, are marked "3×" in the page's own comments (web/src/stream.js).
std::string state_json(const Scene& scene);
std::string truth_json(const Scene& scene);
std::string tracks_json(const Scene& scene);
std::string request_json(const Scene& scene);
/// @param planes  with the certificate's planes
std::string plan_json(const Scene& scene, bool planes);
std::string timing_json(const Scene& scene);
/// Hulls of what moves within `reach` m of the plan, from the newest predictions, at most `most` of them.
std::string hulls_json(const Scene& scene, double reach, int most);
/// Edges of the search's tree, six numbers each.
std::string search_json(const Scene& scene);
std::string map_json(const Scene& scene);
/// @param now  ages are counted to it
std::string health_json(const Scene& scene, UTime now);
std::string goal_json(const Scene& scene);
std::string result_json(const Scene& scene);

/// All that was heard of one thing, for people: {"title": …, "messages": [{"channel": …, fields …}]}.
std::string detail_json(const Scene& scene, const PickCommand& pick);

}  // namespace tern
