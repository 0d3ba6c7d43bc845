// A site for the tests: the origin is on the Irchel in Zurich.
#pragma once

#include "mission/step_list.h"

namespace tern::mission::testing {

inline constexpr GeodeticPoint kOrigin{47.3977, 8.5456, 488.0};

inline Site some_site() {
  Site site;
  site.frame = LocalFrame::at(kOrigin).value();
  site.no_frame = "no origin";
  site.home = Vec3(0.0, 0.0, 1.0);
  site.landing_height = 1.0;
  return site;
}

inline Site site_without_origin() {
  Site site = some_site();
  site.frame.reset();
  return site;
}

/// A plan as QGroundControl writes it: take-off, three waypoints (the second one with a hold), return to launch; and
/// fences.
inline constexpr char kPlan[] = R"({
  "fileType": "Plan", "groundStation": "QGroundControl", "version": 1,
  "geoFence": {"version": 2,
    "polygons": [{"inclusion": true, "version": 1,
      "polygon": [[47.3972, 8.5450], [47.3972, 8.5465], [47.3985, 8.5465], [47.3985, 8.5450]]}],
    "circles": [{"inclusion": false, "version": 1, "circle": {"center": [47.3980, 8.5460], "radius": 5}}]},
  "mission": {"version": 2, "cruiseSpeed": 15, "hoverSpeed": 5, "firmwareType": 12, "vehicleType": 2,
    "plannedHomePosition": [47.3977, 8.5456, 488],
    "items": [
      {"type": "SimpleItem", "autoContinue": true, "command": 22, "doJumpId": 1, "frame": 3,
       "params": [0, 0, 0, null, 47.3977, 8.5456, 10]},
      {"type": "SimpleItem", "autoContinue": true, "command": 16, "doJumpId": 2, "frame": 3,
       "params": [0, 0, 0, null, 47.3979, 8.5456, 10]},
      {"type": "SimpleItem", "autoContinue": true, "command": 16, "doJumpId": 3, "frame": 3,
       "params": [4, 3, 0, null, 47.3979, 8.5459, 12]},
      {"type": "SimpleItem", "autoContinue": true, "command": 16, "doJumpId": 4, "frame": 0,
       "params": [0, 3, 0, null, 47.3977, 8.5459, 500]},
      {"type": "SimpleItem", "autoContinue": true, "command": 20, "doJumpId": 5, "frame": 2,
       "params": [0, 0, 0, 0, 0, 0, 0]}]},
  "rallyPoints": {"points": [], "version": 2}})";

inline constexpr char kCsv[] =
    "# a mission in W\n"
    "x, y, z, action, hold_s, radius_m, track, name\n"
    "5, 0, 2, , , 3, , gate\n"
    "10, 5, 2, stop, 4, , , look\n"
    "-3, 0, 1, follow, 20, , 7,\n"
    "0, 0, 0, land, , , , \n";

inline constexpr char kGeoJson[] = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"name": "gate", "radius_m": 3},
   "geometry": {"type": "Point", "coordinates": [8.5457, 47.3978, 10]}},
  {"type": "Feature", "properties": {"fence": "inclusion", "floor": 0, "ceiling": 30},
   "geometry": {"type": "Polygon", "coordinates":
     [[[8.5450, 47.3972], [8.5465, 47.3972], [8.5465, 47.3985], [8.5450, 47.3985], [8.5450, 47.3972]]]}},
  {"type": "Feature", "properties": {"fence": "exclusion", "radius_m": 5, "name": "mast"},
   "geometry": {"type": "Point", "coordinates": [8.5460, 47.3980]}},
  {"type": "Feature", "properties": {},
   "geometry": {"type": "LineString", "coordinates": [[8.5458, 47.3978, 10], [8.5459, 47.3979, 12]]}}]})";

}  // namespace tern::mission::testing
