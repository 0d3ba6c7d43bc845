// Every answer of a log, planned again and compared.
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

/// Which answers, and with which settings.
struct ReplayOptions {
  std::string suffix;                   ///< of the vehicle's channels
  std::optional<double> from_s, to_s;   ///< of the log's time: seconds since its first message
  std::optional<std::int64_t> request;  ///< answers to requests of this id alone
  OtherSettings other;                  ///< what-if; empty: as recorded
};

/// Whether an answer is one of those asked for.
bool is_chosen(const RecordedPlan& recorded, const LogContents& log, const ReplayOptions& options);

/// What became of one answer.
struct ReplayedPlan {
  std::size_t index = 0;                      ///< in RecordedInputs::plans
  std::string missing;                        ///< what the log does not hold of its inputs; empty: it was replayed
  std::string tolerance_reason;               ///< why only kReplayTolerance is promised; empty: the same bytes are
  PlanOutcome outcome = PlanOutcome::NoPlan;  ///< of the plan made again
  PlanDifference difference;
};

struct Replay {
  RecordedInputs inputs;
  std::string suffix;       ///< of the channels that were read
  LogContents predictions;  ///< as read_prediction_sets saw the log
  std::vector<ReplayedPlan> plans;

  [[nodiscard]] std::int64_t count(Agreement agreement) const;  ///< of those that were replayed
  [[nodiscard]] std::int64_t missing() const;
  /// Those that do not keep the promise that holds for them.
  [[nodiscard]] std::int64_t unfulfilled() const;
  /// Whether the log is an extract (write_log): then gaps in its senders' numbers mean nothing.
  [[nodiscard]] bool is_extract() const;
  /// Answers that planners numbered before the first one that the log has of them; 0 for an extract.
  [[nodiscard]] std::int64_t answers_before() const;
  /// Whether the log lacks anything that a replay needs: inputs, answers that were lost, refused or damaged.
  [[nodiscard]] bool incomplete() const;
};

/// Reads the log twice, the predictions in the second pass; memory is bounded by what answers, requests and maps take.
/// Costs what planning cost. @return an Error when the log cannot be opened, holds not one whole event, or has answers
/// of which none is chosen.
/// @throws ConfigError for other settings that are not well-formed or cannot take effect.
Result<Replay> replay_log(const std::string& path, const ReplayOptions& options);

/// Why a replay here of an answer of that log may differ in its last bits; empty: it may not.
std::string tolerance_reason(const RecordedInputs& inputs, const Plan& plan);

}  // namespace tern
