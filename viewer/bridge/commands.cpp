#include "viewer/bridge/commands.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/wire/message_limits.h"
#include "core/world/names.h"

namespace tern {
namespace {

using nlohmann::json;

/// Thrown and caught in this file only.
struct Refused {
  std::string why;
};

void check(bool ok, const char* why) {
  if (!ok) throw Refused{why};
}

double number(const json& value, double low, double high) {
  check(value.is_number(), "not a number");
  const double x = value.get<double>();
  check(std::isfinite(x) && low <= x && x <= high, "a number out of range");
  return x;
}

std::int64_t integer(const json& value) {
  check(value.is_number_integer(), "not an integer");
  check(!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX, "a number out of range");
  return value.get<std::int64_t>();
}

std::string text(const json& value) {
  check(value.is_string(), "not a text");
  return value.get<std::string>();
}

template <class Enum, std::size_t N>
Enum choice(const json& value, const std::array<std::pair<const char*, Enum>, N>& words) {
  const std::string word = text(value);
  for (const auto& [name, meaning] : words) {
    if (word == name) return meaning;
  }
  throw Refused{"unknown word " + word};
}

void only_members(const json& object, std::initializer_list<const char*> names) {
  check(object.is_object(), "not an object");
  for (const auto& [key, value] : object.items()) {
    bool known = false;
    for (const char* name : names) known = known || key == name;
    if (!known) throw Refused{"unknown member " + key};
  }
}

LayersCommand layers(const json& value) {
  check(value.is_array(), "layers are a list");
  LayersCommand command;
  for (const json& entry : value) {
    const std::string name = text(entry);
    if (name == "hulls") {
      command.hulls = true;
    } else if (name == "tracks") {
      command.tracks = true;
    } else if (name == "planes") {
      command.planes = true;
    } else if (name == "search") {
      command.search = true;
    } else {
      throw Refused{"unknown layer " + name};
    }
  }
  return command;
}

SeriesCommand series(const json& value) {
  check(value.is_array() && value.size() <= kMaxSeries, "series are a list of at most 36 names");
  SeriesCommand command;
  for (const json& entry : value) {
    command.names.push_back(text(entry));
    check(command.names.back().size() <= kMaxSeriesNameBytes, "the name of a series is too long");
  }
  return command;
}

PickCommand pick(const json& value) {
  constexpr std::array<std::pair<const char*, PickKind>, 8> kKinds = {{{"vehicle", PickKind::Vehicle},
                                                                       {"obstacle", PickKind::Obstacle},
                                                                       {"plan", PickKind::Plan},
                                                                       {"request", PickKind::Request},
                                                                       {"goal", PickKind::Goal},
                                                                       {"map", PickKind::Map},
                                                                       {"process", PickKind::Process},
                                                                       {"result", PickKind::Result}}};
  only_members(value, {"kind", "id", "name"});
  check(value.contains("kind"), "a pick needs a kind");
  PickCommand command{choice(value["kind"], kKinds), 0, ""};
  if (value.contains("id")) command.id = integer(value["id"]);
  if (value.contains("name")) command.name = text(value["name"]);
  return command;
}

Command player(const json& value) {
  only_members(value, {"play", "seek_us", "step", "speed"});
  check(value.size() == 1, "a message must hold exactly one command");
  if (value.contains("play")) {
    check(value["play"].is_boolean(), "play must be true or false");
    return PlayCommand{value["play"].get<bool>()};
  }
  if (value.contains("seek_us")) return SeekCommand{integer(value["seek_us"])};
  if (value.contains("speed")) return SpeedCommand{number(value["speed"], 0.01, 100.0)};
  const std::int64_t step = integer(value["step"]);
  check(step == 1 || step == -1, "a step is 1 or -1");
  return StepCommand{static_cast<int>(step)};
}

GoalCommand goal(const json& value) {
  only_members(value, {"mode", "position"});
  GoalCommand command;
  if (value.contains("mode")) {
    const auto mode = named<GoalMode>(text(value["mode"]));
    check(mode.has_value(), "unknown mode");
    command.mode = *mode;
  }
  if (command.mode != GoalMode::Go) return command;
  check(value.contains("position") && value["position"].is_array() && value["position"].size() == 3,
        "a goal needs a position of three numbers");
  for (int axis = 0; axis < 3; ++axis) {
    command.position[axis] = number(value["position"][idx(axis)], -kMaxCoordinate, kMaxCoordinate);
  }
  return command;
}

Command parse(const json& value) {
  only_members(value, {"layers", "series", "pick", "player", "goal"});
  check(value.size() == 1, "a message must hold exactly one command");
  if (value.contains("layers")) return layers(value["layers"]);
  if (value.contains("series")) return series(value["series"]);
  if (value.contains("pick")) return pick(value["pick"]);
  if (value.contains("player")) return player(value["player"]);
  return goal(value["goal"]);
}

}  // namespace

Result<Command> parse_command(std::string_view text) {
  try {
    const json value = json::parse(text.begin(), text.end(), nullptr, false);
    check(!value.is_discarded(), "not JSON");
    return parse(value);
  } catch (const Refused& refused) {
    return fail(refused.why);
  }
}

}  // namespace tern
