#include "mission/readers/entry.h"

#include <fmt/format.h>

namespace tern::mission {
namespace {

/// Messages carry only valid text: whatever is not printable ASCII becomes '?'.
std::string plain(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

/// Returns which value has no meaning for the action; "" if each has one.
std::string useless_value(const Entry& entry, const std::string& action) {
  const bool is_pass = action == "pass";
  if (entry.radius && !is_pass) return "radius_m";
  if (entry.hold_s && (is_pass || action == "land" || action == "return")) return "hold_s";
  if (entry.track && action != "follow") return "track";
  if (entry.place && action == "return") return "a position";
  return "";
}

}  // namespace

Result<void> add_entry(const Entry& entry, StepList& steps) {
  const double hold_s = entry.hold_s.value_or(0.0), radius = entry.radius.value_or(0.0);
  const std::string action = entry.action.empty() ? (hold_s > 0.0 ? "stop" : "pass") : entry.action;
  const std::string name = entry.name.empty() ? fmt::format("waypoint {}", entry.item) : plain(entry.name);
  const bool is_plain_zero = entry.action.empty() && hold_s == 0.0;
  Entry used = entry;
  if (is_plain_zero) used.hold_s.reset();
  if (const std::string what = useless_value(used, action); !what.empty()) {
    return fail(fmt::format("action {}: {} has no meaning", action, what));
  }
  if (!entry.place && action != "return") return fail(fmt::format("action {}: a position is needed", action));
  const Vec3 place = entry.place.value_or(Vec3::Zero());
  if (const std::string why = why_no_step(place, radius, hold_s); !why.empty()) return fail(why);
  if (entry.speed && !(*entry.speed > 0.0)) return fail(fmt::format("a speed of {} m/s cannot be flown", *entry.speed));
  if (const std::string why = why_no_speed(entry.speed.value_or(0.0)); !why.empty()) return fail(why);
  steps.set_speed(entry.speed.value_or(0.0));
  if (action == "pass") {
    steps.waypoint(name, entry.item, place, radius, 0.0);
  } else if (action == "stop") {
    steps.stop(name, entry.item, place, hold_s);
  } else if (action == "land") {
    steps.land(entry.item, place);
  } else if (action == "return") {
    steps.go_home(entry.item);
  } else if (action == "follow") {
    if (!entry.track || !(hold_s > 0.0)) return fail("action follow: track and hold_s > 0 are needed");
    steps.follow(name, entry.item, *entry.track, place, hold_s);
  } else {
    return fail(fmt::format("action {} is not pass, stop, land, return or follow", action));
  }
  return {};
}

Result<Vec3> place_of(bool geodetic, double a, double b, double c, const Site& site) {
  if (!geodetic) return Vec3(a, b, c);
  if (!site.frame) return fail(site.no_frame);
  const GeodeticPoint place{a, b, site.frame->origin().height + c};
  if (const std::string why = why_not_on_earth(place); !why.empty()) return fail(why);
  return site.frame->to_world(place);
}

}  // namespace tern::mission
