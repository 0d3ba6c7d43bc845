// The scene as JSON, one value per topic; "null" if nothing was received.
#pragma once

#include <string>

#include "viewer/bridge/commands.h"
#include "viewer/bridge/number_writer.h"
#include "viewer/bridge/scene.h"

namespace tern {

/// Flat lists, one number after the other, are marked "3×" in the page's comments (web/src/stream.js).
std::string state_json(const Scene& scene);
std::string truth_json(const Scene& scene);
std::string tracks_json(const Scene& scene);
std::string request_json(const Scene& scene);
/// @param planes  include the certificate's planes
std::string plan_json(const Scene& scene, bool planes);
std::string timing_json(const Scene& scene);
/// Hulls of the moving tracks within `reach` m of the plan, from the newest predictions, for the intervals that begin
/// before `ahead`; at most `most`.
std::string hulls_json(const Scene& scene, Duration ahead, double reach, int most);
/// The newest detections of each sensor, and the moving tracks with their α at present and their age.
std::string tracked_json(const Scene& scene, const TrackAges& ages);
/// Outlines of the fields of view, from the newest frame of each sensor, two points per line. The heading along the
/// newest plan: [x, y, z, yaw, …].
std::string views_json(const Scene& scene);
/// The newest frame of each sensor with a view, and the time of the vehicle's state, or else of the newest frame.
/// Depths are in decimetres, row by row; −1: nothing within the range, 0: not measured. Sightings have six numbers of
/// BoundSight each. "unseen": the cells about the vehicle that no sensor has seen for a second, as [x, y, count, …]
/// (SeenCells::Run); absent before the first state.
std::string sight_json(const Scene& scene);
/// The estimate of the position, the axes of its 99 % ellipsoid, and the true vehicle. The axes are half-lengths and a
/// quaternion w, x, y, z. The features of the newest frame are [x, y, z, moves, u, v, …]: 1 on a moving
/// obstacle, and the coordinates in the left camera.
std::string estimate_json(const Scene& scene);
/// Distance of the estimate from the truth and the half-length of the ellipsoid's longest axis, m; NaN if unknown.
NumberFields estimate_numbers(const Scene& scene);
/// Edges of the search tree, six numbers each.
std::string search_json(const Scene& scene);
std::string map_json(const Scene& scene);
/// @param now  ages are relative to it
std::string health_json(const Scene& scene, UTime now);
std::string goal_json(const Scene& scene);
std::string result_json(const Scene& scene);

/// All messages of one picked object, for people: {"title": …, "messages": [{"channel": …, fields …}]}; for a true
/// obstacle also "clearance_m".
std::string detail_json(const Scene& scene, const PickCommand& pick);
/// The numbers that detail_json() shows of the vehicle's state, and of the plan and its timing.
NumberFields vehicle_numbers(const Scene& scene);
NumberFields plan_numbers(const Scene& scene);

}  // namespace tern
