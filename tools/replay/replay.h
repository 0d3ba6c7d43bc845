// Plans every answer of a log again and compares.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "tools/replay/plan_difference.h"
#include "tools/replay/recorded_inputs.h"
#include "tools/replay/world_rebuilder.h"

namespace tern {

/// Selects answers and settings.
struct ReplayOptions {
  std::string suffix;                   ///< of the vehicle's channels
  std::optional<double> from_s, to_s;   ///< of the log's time: seconds since its first message
  std::optional<std::int64_t> request;  ///< only answers to requests with this id
  OtherSettings other;                  ///< changed settings for a what-if replay; empty: as recorded
};

/// Returns true if the options select this answer.
bool is_chosen(const RecordedPlan& recorded, const LogContents& log, const ReplayOptions& options);

/// The result for one answer.
struct ReplayedPlan {
  std::size_t index = 0;         ///< in RecordedInputs::plans
  std::string missing;           ///< the inputs that the log lacks; empty: it was replayed
  std::string tolerance_reason;  ///< why only kReplayTolerance is promised; empty: identical bytes are promised
  PlanOutcome outcome = PlanOutcome::NoPlan;  ///< of the new plan
  PlanDifference difference;
};

/// The replay of a log.
struct Replay {
  RecordedInputs inputs;
  std::string suffix;       ///< of the channels that were read
  LogContents predictions;  ///< as read_prediction_sets() saw the log
  std::vector<ReplayedPlan> plans;

  [[nodiscard]] std::int64_t count(Agreement agreement) const;  ///< of the replayed answers
  [[nodiscard]] std::int64_t missing() const;
  /// Returns how many replayed answers differ by more than is promised for them.
  [[nodiscard]] std::int64_t unfulfilled() const;
  /// Returns true if write_log() wrote the log. Gaps in sequence numbers then mean nothing.
  [[nodiscard]] bool is_extract() const;
  /// Returns how many answers the planners numbered before the log's first one; 0 for an extract.
  [[nodiscard]] std::int64_t answers_before() const;
  /// Returns true if the log lacks inputs, or if answers were lost, refused or damaged.
  [[nodiscard]] bool incomplete() const;
};

/// Reads the log twice, predictions in the second pass, and plans each selected answer again. Memory is bounded by
/// answers, requests and maps; the time is that of planning.
/// @return an Error if the log is unreadable or without a complete message, or if a selected answer is missing
/// @throws ConfigError if a what-if setting is malformed or can have no effect
Result<Replay> replay_log(const std::string& path, const ReplayOptions& options);

/// Returns why a replay on this machine may differ from that log in its last bits; empty: it may not.
std::string tolerance_reason(const RecordedInputs& inputs, const Plan& plan);

}  // namespace tern
