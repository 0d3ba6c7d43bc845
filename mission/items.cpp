#include "mission/items.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace tern::mission {
namespace {

constexpr int kWaypoint = 16, kLoiterTime = 19, kReturn = 20, kLand = 21, kTakeoff = 22, kDelay = 93,
              kChangeSpeed = 178;

/// Commands that plans often have, by the names of MAVLink's common.xml.
constexpr std::pair<int, const char*> kNames[] = {{16, "NAV_WAYPOINT"},
                                                  {17, "NAV_LOITER_UNLIM"},
                                                  {18, "NAV_LOITER_TURNS"},
                                                  {19, "NAV_LOITER_TIME"},
                                                  {20, "NAV_RETURN_TO_LAUNCH"},
                                                  {21, "NAV_LAND"},
                                                  {22, "NAV_TAKEOFF"},
                                                  {31, "NAV_LOITER_TO_ALT"},
                                                  {34, "DO_ORBIT"},
                                                  {82, "NAV_SPLINE_WAYPOINT"},
                                                  {84, "NAV_VTOL_TAKEOFF"},
                                                  {85, "NAV_VTOL_LAND"},
                                                  {92, "NAV_GUIDED_ENABLE"},
                                                  {93, "NAV_DELAY"},
                                                  {94, "NAV_PAYLOAD_PLACE"},
                                                  {112, "CONDITION_DELAY"},
                                                  {114, "CONDITION_DISTANCE"},
                                                  {115, "CONDITION_YAW"},
                                                  {176, "DO_SET_MODE"},
                                                  {177, "DO_JUMP"},
                                                  {178, "DO_CHANGE_SPEED"},
                                                  {179, "DO_SET_HOME"},
                                                  {181, "DO_SET_RELAY"},
                                                  {183, "DO_SET_SERVO"},
                                                  {189, "DO_LAND_START"},
                                                  {193, "DO_PAUSE_CONTINUE"},
                                                  {195, "DO_SET_ROI_LOCATION"},
                                                  {197, "DO_SET_ROI_NONE"},
                                                  {201, "DO_SET_ROI"},
                                                  {203, "DO_DIGICAM_CONTROL"},
                                                  {205, "DO_MOUNT_CONTROL"},
                                                  {206, "DO_SET_CAM_TRIGG_DIST"},
                                                  {207, "DO_FENCE_ENABLE"},
                                                  {211, "DO_GRIPPER"},
                                                  {214, "DO_SET_CAM_TRIGG_INTERVAL"},
                                                  {530, "SET_CAMERA_MODE"},
                                                  {1000, "DO_GIMBAL_MANAGER_PITCHYAW"},
                                                  {2000, "IMAGE_START_CAPTURE"},
                                                  {2001, "IMAGE_STOP_CAPTURE"},
                                                  {2500, "VIDEO_START_CAPTURE"},
                                                  {2501, "VIDEO_STOP_CAPTURE"},
                                                  {3000, "DO_VTOL_TRANSITION"},
                                                  {4501, "CONDITION_GATE"},
                                                  {5000, "NAV_FENCE_RETURN_POINT"},
                                                  {5001, "NAV_FENCE_POLYGON_VERTEX_INCLUSION"},
                                                  {5002, "NAV_FENCE_POLYGON_VERTEX_EXCLUSION"},
                                                  {5003, "NAV_FENCE_CIRCLE_INCLUSION"},
                                                  {5004, "NAV_FENCE_CIRCLE_EXCLUSION"},
                                                  {5100, "NAV_RALLY_POINT"}};

/// Frames of items, by MAVLink's common.xml.
constexpr int kGlobal = 0, kLocalNed = 1, kRelative = 3, kLocalEnu = 4, kGlobalInt = 5, kRelativeInt = 6;

/// The number, or 0 if it is not given.
double given(double param) { return std::isfinite(param) ? param : 0.0; }

class ItemReader {
 public:
  explicit ItemReader(const Site& site) : site_(site), steps_(site) {}

  Result<void> add(const Item& item) {
    item_ = &item;
    if (!item.goes_on) return refuse("stops the mission (autoContinue is false); give it a hold time instead");
    switch (item.command) {
      case kWaypoint: return waypoint();
      case kLoiterTime: return loiter();
      case kReturn: return go_home();
      case kLand: return land();
      case kTakeoff: return take_off();
      case kDelay: return delay();
      case kChangeSpeed: return change_speed();
      default: return refuse("cannot be flown");
    }
  }

  [[nodiscard]] Result<std::vector<Step>> take() { return steps_.take(); }

 private:
  [[nodiscard]] tl::unexpected<Error> refuse(const std::string& why) const {
    return fail(fmt::format("item {}, {}: {}", item_->number, command_name(item_->command), why));
  }

  [[nodiscard]] double param(int number) const { return given(item_->params[idx(number - 1)]); }

  /// Returns why a parameter asks for something that cannot be flown; "" for 0 and NaN, which ask for nothing.
  [[nodiscard]] std::string asks_for(int number, const char* meaning) const {
    return param(number) == 0.0 ? ""
                                : fmt::format("{} (param{} = {}) cannot be flown; set it to 0 or leave it out", meaning,
                                              number, param(number));
  }

  /// Returns the place of the item, or `fallback` at its altitude if it states no latitude and longitude.
  [[nodiscard]] Result<Vec3> place(const std::optional<Vec3>& fallback = {}) const {
    const Item& item = *item_;
    if (!std::isfinite(item.z)) return refuse("has no altitude");
    const bool is_placed = std::isfinite(item.x) && std::isfinite(item.y);
    if (!is_placed && !fallback) return refuse("has no position");
    switch (item.frame) {
      case kLocalNed: return is_placed ? Vec3(item.y, item.x, -item.z) : at_height(*fallback, -item.z);
      case kLocalEnu: return is_placed ? Vec3(item.x, item.y, item.z) : at_height(*fallback, item.z);
      case kGlobal:
      case kGlobalInt: return on_earth(0.0, is_placed ? std::nullopt : fallback);
      case kRelative:
      case kRelativeInt:
        return on_earth(site_.frame ? site_.frame->origin().height : 0.0, is_placed ? std::nullopt : fallback);
      default: break;
    }
    return refuse(fmt::format(
        "frame {} is not supported; use altitudes relative to launch (3) or above mean sea level (0)", item.frame));
  }

  static Vec3 at_height(const Vec3& p, double z) { return {p.x(), p.y(), z}; }

  /// @param base  height from which the altitude counts, m
  /// @param above  W: the place is above or below this one; nullopt: by the item's latitude and longitude
  [[nodiscard]] Result<Vec3> on_earth(double base, const std::optional<Vec3>& above) const {
    if (!site_.frame) return refuse(site_.no_frame);
    GeodeticPoint at = above ? site_.frame->from_world(*above) : GeodeticPoint{item_->x, item_->y, 0.0};
    at.height = base + item_->z;
    if (const std::string why = why_not_on_earth(at); !why.empty()) return refuse(why);
    return site_.frame->to_world(at);
  }

  Result<void> waypoint() {
    for (const std::string& why : {asks_for(3, "a pass radius"), asks_for(4, "a heading")}) {
      if (!why.empty()) return refuse(why);
    }
    const auto p = place();
    if (!p) return tl::unexpected(p.error());
    if (const std::string why = why_no_step(*p, param(2), param(1)); !why.empty()) return refuse(why);
    steps_.waypoint(fmt::format("waypoint {}", item_->number), item_->number, *p, param(2), param(1));
    return {};
  }

  Result<void> loiter() {
    const auto p = place(steps_.last());
    if (!p) return tl::unexpected(p.error());
    if (const std::string why = why_no_step(*p, 0.0, param(1)); !why.empty()) return refuse(why);
    steps_.stop(fmt::format("hold {}", item_->number), item_->number, *p, param(1));
    return {};
  }

  Result<void> take_off() {
    if (const std::string why = asks_for(4, "a heading"); !why.empty()) return refuse(why);
    const auto p = place(site_.home);
    if (!p) return tl::unexpected(p.error());
    if (const std::string why = why_no_step(*p, 0.0, 0.0); !why.empty()) return refuse(why);
    steps_.waypoint(fmt::format("take-off {}", item_->number), item_->number, *p, 0.0, 0.0);
    return {};
  }

  Result<void> land() {
    for (const std::string& why : {asks_for(2, "a precision landing"), asks_for(4, "a heading")}) {
      if (!why.empty()) return refuse(why);
    }
    const auto ground = place(steps_.last());
    if (!ground) return tl::unexpected(ground.error());
    if (const std::string why = why_no_step(*ground, 0.0, 0.0); !why.empty()) return refuse(why);
    steps_.land(item_->number, *ground);
    return {};
  }

  Result<void> go_home() {
    steps_.go_home(item_->number);
    return {};
  }

  Result<void> delay() {
    if (steps_.empty()) return refuse("has no waypoint before it");
    if (const std::string why = why_no_step(Vec3::Zero(), 0.0, param(1)); !why.empty()) return refuse(why);
    steps_.stay_longer(param(1));
    return {};
  }

  /// Of a multicopter airspeed (param1 = 0) is ground speed (1). A speed of −1 and a throttle of −1 change nothing.
  Result<void> change_speed() {
    constexpr double kGroundSpeed = 1.0, kUnchanged = -1.0, kDefault = -2.0;
    if (param(1) != 0.0 && param(1) != kGroundSpeed) {
      return refuse(fmt::format("param1 = {} is not a ground speed (1)", param(1)));
    }
    if (param(3) != 0.0 && param(3) != kUnchanged) return refuse(asks_for(3, "a throttle"));
    const double speed = param(2) == kDefault ? 0.0 : param(2);
    if (speed == kUnchanged) return {};
    if (speed == 0.0 && param(2) == 0.0) return refuse("a speed of 0 m/s cannot be flown");
    if (const std::string why = why_no_speed(speed); !why.empty()) return refuse(why);
    steps_.set_speed(speed);
    return {};
  }

  const Site& site_;
  const Item* item_ = nullptr;
  StepList steps_;
};

}  // namespace

std::string command_name(int command) {
  const auto* const named =
      std::find_if(std::begin(kNames), std::end(kNames), [&](const auto& n) { return n.first == command; });
  return named == std::end(kNames) ? fmt::format("MAV_CMD {}", command)
                                   : fmt::format("MAV_CMD_{} ({})", named->second, command);
}

Result<std::vector<Step>> steps_of(const std::vector<Item>& items, const Site& site) {
  ItemReader reader(site);
  for (const Item& item : items) {
    if (const auto added = reader.add(item); !added) return tl::unexpected(added.error());
  }
  return reader.take();
}

}  // namespace tern::mission
