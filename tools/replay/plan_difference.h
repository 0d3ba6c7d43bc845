// Compares two answers to one request: how far they agree, and which stage makes the first difference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/world/plan_heading.h"
#include "planner/planner.h"

namespace tern {

/// Positions of equivalent plans agree to this on another machine, m; identical bytes are promised on the same machine.
inline constexpr double kReplayTolerance = 1e-6;

enum class Agreement : std::uint8_t {
  Identical = 0,   ///< byte for byte
  Equivalent = 1,  ///< the same outcome, and positions within kReplayTolerance at all times
  Different = 2,
};

/// A part in which the answers differ.
struct PartDifference {
  Stage stage = Stage::Check;  ///< the stage that produces this part
  std::string what;            ///< in words, with both values
};

/// The comparison of two answers.
struct PlanDifference {
  Agreement agreement = Agreement::Identical;
  double position_m = 0.0;            ///< the largest distance between the trajectories at equal times
  std::vector<PartDifference> parts;  ///< in order of the stages: the first one is where the answers part
};

/// Compares the trajectories and every part of two answers.
/// @param recorded, again  answers to one request; headers are not compared
/// @param recorded_work, work  counted work of both, null if unknown. It tells stages apart that leave no trace in the
/// plan, such as an optimizer that made the same trajectory of another leaf
PlanDifference difference_of(const Plan& recorded, const Plan& again, const PlanTiming* recorded_work,
                             const PlanStatistics* work);

/// Adds the difference of an answer's heading. Yaws within kReplayTolerance, rad, are equivalent.
/// @param again  nullopt: the answer has no heading now
void add_heading(const PlanHeading& recorded, const std::optional<PlanHeading>& again, PlanDifference& difference);

}  // namespace tern
