// The commands that a page may send.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/world/goal.h"

namespace tern {

/// {"layers": ["hulls", "planes", "search", "tracks"]}: the optional layers that the page shows.
struct LayersCommand {
  bool hulls = false, planes = false, search = false, tracks = false;
};

/// {"series": ["UAV_STATE.speed_mps"]}: the fields that the page charts.
struct SeriesCommand {
  std::vector<std::string> names;
};
inline constexpr std::size_t kMaxSeries = 36, kMaxSeriesNameBytes = 96;

enum class PickKind : std::uint8_t { Vehicle, Obstacle, Plan, Request, Goal, Map, Process, Result };

/// {"pick": {"kind": "obstacle", "id": 7}} or {"pick": {"kind": "process", "name": "tern-planner"}}: asks for the
/// messages of that object.
struct PickCommand {
  PickKind kind = PickKind::Vehicle;
  std::int64_t id = 0;  ///< of an obstacle
  std::string name;     ///< of a process
};

/// The player's commands: {"player": {"play": true}}, {"player": {"seek_us": t}}, {"player": {"step": -1}} and
/// {"player": {"speed": 0.25}}.
struct PlayCommand {
  bool play = false;
};
struct SeekCommand {
  std::int64_t at_us = 0;  ///< µs since the Unix epoch; limited to the log's time
};
struct StepCommand {
  int plans = 0;  ///< to the next (1) or previous (−1) answer of the planner
};
struct SpeedCommand {
  double factor = 1.0;  ///< 0.01 … 100
};

/// {"goal": {"mode": "go", "position": [x, y, z]}}; "hold" and "stop" ignore the position.
struct GoalCommand {
  GoalMode mode = GoalMode::Go;
  Vec3 position = Vec3::Zero();  ///< W, m
};

using Command = std::variant<LayersCommand, SeriesCommand, PickCommand, PlayCommand, SeekCommand, StepCommand,
                             SpeedCommand, GoalCommand>;

/// Parses exactly one command. Unknown members are refused, and numbers must be finite and in range. Never throws.
Result<Command> parse_command(std::string_view json);

}  // namespace tern
