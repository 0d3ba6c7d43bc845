// How far two answers to one request agree, and where they part.
#pragma once

#include <string>
#include <vector>

#include "planner/planner.h"

namespace tern {

/// Plans that agree to this are the same on another machine, m: DESIGN's promise where bytes cannot be promised.
inline constexpr double kReplayTolerance = 1e-6;

enum class Agreement : std::uint8_t {
  Identical = 0,   ///< byte for byte
  Equivalent = 1,  ///< the same outcome, and positions to kReplayTolerance at all times
  Different = 2,
};

/// A part of the two answers that differs.
struct PartDifference {
  Stage stage = Stage::Check;  ///< the stage that makes this part
  std::string what;            ///< in words, with both values
};

struct PlanDifference {
  Agreement agreement = Agreement::Identical;
  double position_m = 0.0;            ///< the largest distance between the two trajectories at one time
  std::vector<PartDifference> parts;  ///< in the order of the stages, so the first is where the answers part
};

/// @param recorded, again  answers to one request; the header is not compared
/// @param recorded_work, work what they cost in countable things, where known. Tells apart stages that leave no trace
/// in the plan (an optimizer that made the same of another search's leaf)
PlanDifference difference_of(const Plan& recorded, const Plan& again, const PlanTiming* recorded_work,
                             const PlanStatistics* work);

}  // namespace tern
