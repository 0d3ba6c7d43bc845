// What a page may ask of the bridge.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/world/goal.h"

namespace tern {

/// {"layers": ["hulls", "planes", "search"]}: what this page shows of that which is not always sent.
struct LayersCommand {
  bool hulls = false, planes = false, search = false;
};

/// {"series": ["UAV_STATE.speed_mps"]}: the fields that this page charts.
struct SeriesCommand {
  std::vector<std::string> names;
};
inline constexpr std::size_t kMaxSeries = 36, kMaxSeriesNameBytes = 96;

enum class PickKind : std::uint8_t { Vehicle, Obstacle, Plan, Request, Goal, Map, Process, Result };

/// {"pick": {"kind": "obstacle", "id": 7}} or {"pick": {"kind": "process", "name": "tern-planner"}}: its messages,
/// please.
struct PickCommand {
  PickKind kind = PickKind::Vehicle;
  std::int64_t id = 0;  ///< of an obstacle
  std::string name;     ///< of a process
};

/// {"player": {"play": true}}, {"player": {"seek_us": t}}, {"player": {"step": -1}}, {"player": {"speed": 0.25}}.
struct PlayCommand {
  bool play = false;
};
struct SeekCommand {
  std::int64_t at_us = 0;  ///< µs since the Unix epoch; what lies outside the log means its begin or end
};
struct StepCommand {
  int plans = 0;  ///< to the next (1) or last (−1) answer of the planner
};
struct SpeedCommand {
  double factor = 1.0;  ///< 0.01 … 100
};

/// {"goal": {"mode": "go", "position": [x, y, z]}}; the position is not read for "hold" and "stop".
struct GoalCommand {
  GoalMode mode = GoalMode::Go;
  Vec3 position = Vec3::Zero();  ///< W, m
};

using Command = std::variant<LayersCommand, SeriesCommand, PickCommand, PlayCommand, SeekCommand, StepCommand,
                             SpeedCommand, GoalCommand>;

/// Strict: exactly one command, no unknown members, every number finite and in range. Never throws on any bytes.
Result<Command> parse_command(std::string_view json);

}  // namespace tern
