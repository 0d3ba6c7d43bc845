// Extracts some answers of a log, with their inputs and nothing else, to keep, to send or to test with.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "tools/replay/replay.h"

namespace tern {

/// A log written by write_log() has a message on this channel. It marks the log's gaps as deliberate.
inline constexpr char kExtractMark[] = "TERN_EXTRACT";

/// Answers and all of their inputs.
struct Extract {
  RecordedInputs inputs;
  /// Complete sets in the log's order: those that the plans name, and those from which static tracks were taken.
  std::vector<TrackSet> predictions;
};

/// Reads answers and their inputs from a log.
/// @param options  selects the answers; its other settings are ignored
/// @param every    keeps every n-th of them, n ≥ 1
Result<Extract> extract(const std::string& path, const ReplayOptions& options, int every = 1);

/// Writes the extract as a log. The file must not exist. Its replay gives the same answers.
Result<void> write_log(const Extract& extract, const std::string& path);

/// Writes the extract as text (text_log.h), headed by a comment with request and answer. tern-replay reads it like a
/// log; unit tests read it with load_fixture() (tests/support/fixture.h).
Result<void> write_fixture(const Extract& extract, const std::string& path);

/// Writes an extract of the log at `path` to a log, a fixture, or both. An empty name skips that file.
Result<void> write_extract(const std::string& path, const ReplayOptions& options, const std::string& log,
                           const std::string& fixture);

}  // namespace tern
