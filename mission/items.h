// The items of a MAVLink mission as steps: what QGroundControl writes into plans and sends over MAVLink.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "mission/step_list.h"

namespace tern::mission {

/// One item: MISSION_ITEM_INT, or a SimpleItem of a plan. Parameters that are not given are NaN.
struct Item {
  int number = 0;   ///< for messages: doJumpId of a plan, seq of MAVLink
  int command = 0;  ///< MAV_CMD
  int frame = 0;    ///< MAV_FRAME
  std::array<double, 4> params = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  double x = std::numeric_limits<double>::quiet_NaN();  ///< latitude, degrees; in a local frame m
  double y = std::numeric_limits<double>::quiet_NaN();  ///< longitude, degrees; in a local frame m
  double z = std::numeric_limits<double>::quiet_NaN();  ///< altitude, m, by the frame
  bool goes_on = true;                                  ///< autoContinue
};

/// Returns the steps of the items. The altitude of a relative frame counts from the origin's height.
///
/// | command                   | steps                                                              |
/// |---------------------------|--------------------------------------------------------------------|
/// | NAV_WAYPOINT (16)         | Pass within param2; with a hold (param1) Stop                      |
/// | NAV_LOITER_TIME (19)      | Stop for param1 seconds: a multicopter hovers, whatever the radius |
/// | NAV_RETURN_TO_LAUNCH (20) | StepList::go_home                                                  |
/// | NAV_LAND (21)             | StepList::land; without a place at that of the step before         |
/// | NAV_TAKEOFF (22)          | Pass above home or the given place                                 |
/// | NAV_DELAY (93)            | the step before becomes a Stop, and stays longer by param1 seconds |
/// | DO_CHANGE_SPEED (178)     | the speed (param2, m/s) of the steps after it; −2: the vehicle's   |
///
/// Everything else is refused, with the item's number and the command's name:
/// - other commands, and of DO_CHANGE_SPEED speeds of climb and descent (param1) and throttles (param3);
/// - frames other than 0, 3, 5, 6 (latitude, longitude), 1 and 4 (W);
/// - a heading, which executor.heading decides;
/// - an item without autoContinue.
Result<std::vector<Step>> steps_of(const std::vector<Item>& items, const Site& site);

/// Returns "MAV_CMD_NAV_WAYPOINT (16)", or "MAV_CMD 31999" for a number without a name here.
std::string command_name(int command);

}  // namespace tern::mission
