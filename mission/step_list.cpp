#include "mission/step_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tern::mission {
namespace {

/// A place this near horizontally is above the landing place, m.
constexpr double kAbove = 0.5;

}  // namespace

void StepList::waypoint(const std::string& name, int item, const Vec3& p, double radius, double hold_s) {
  if (hold_s > 0.0) return stop(name, item, p, hold_s);
  add({name, item, Action::Pass, p, radius, 0.0, 0});
}

void StepList::stop(const std::string& name, int item, const Vec3& p, double hold_s) {
  add({name, item, Action::Stop, p, 0.0, hold_s, 0});
}

void StepList::land(int item, const Vec3& ground) {
  descend(fmt::format("landing {}", item), item, ground + Vec3(0.0, 0.0, site_.landing_height));
}

void StepList::go_home(int item) { descend(fmt::format("return {}", item), item, site_.home); }

void StepList::follow(const std::string& name, int item, std::int64_t track, const Vec3& offset, double hold_s) {
  add({name, item, Action::Follow, offset, 0.0, hold_s, track});
}

void StepList::add(Step step) {
  step.speed = speed_;
  steps_.push_back(std::move(step));
}

void StepList::stay_longer(double hold_s) {
  Step& last = steps_.back();
  if (last.action == Action::Pass) last.action = Action::Stop;
  last.hold_s += hold_s;
}

const Vec3& StepList::last() const {
  const auto step =
      std::find_if(steps_.rbegin(), steps_.rend(), [](const Step& s) { return s.action != Action::Follow; });
  return step == steps_.rend() ? site_.home : step->position;
}

void StepList::descend(const std::string& name, int item, const Vec3& low) {
  const Vec3 from = last();
  if (from.z() > low.z() && (from - low).head<2>().norm() > kAbove) {
    add({fmt::format("above {}", name), item, Action::Pass, {low.x(), low.y(), from.z()}, 0.0, 0.0, 0});
  }
  stop(name, item, low, 0.0);
}

Result<std::vector<Step>> StepList::take() {
  if (steps_.empty()) return fail("has no waypoint");
  if (steps_.size() > static_cast<std::size_t>(kMaxSteps)) {
    return fail(fmt::format("takes {} steps (limit {})", steps_.size(), kMaxSteps));
  }
  if (steps_.back().action == Action::Pass) steps_.back().action = Action::Stop;
  return std::move(steps_);
}

bool asks_for_other_speed(std::string_view name) {
  if (name == "speed") return false;
  std::string lower;
  for (const char c : name) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower.find("speed") != std::string::npos || lower.find("velocity") != std::string::npos;
}

std::string why_no_speed(double speed) {
  if (speed == 0.0 || (speed >= kMinSpeed && speed <= kMaxSpeed)) return "";
  return fmt::format("a speed of {} m/s is out of range [{}, {}]", speed, kMinSpeed, kMaxSpeed);
}

std::string why_no_step(const Vec3& position, double radius, double hold_s) {
  if (!position.allFinite() || position.cwiseAbs().maxCoeff() > kMaxDistance) {
    return fmt::format("position ({}, {}, {}) m is farther than {} m from the origin", position.x(), position.y(),
                       position.z(), kMaxDistance);
  }
  if (!(radius >= 0.0 && radius <= kMaxRadius)) {
    return fmt::format("a radius of {} m is out of range [0, {}]", radius, kMaxRadius);
  }
  if (!(hold_s >= 0.0 && hold_s <= kMaxHoldS)) {
    return fmt::format("a hold of {} s is out of range [0, {}]", hold_s, kMaxHoldS);
  }
  return "";
}

}  // namespace tern::mission
