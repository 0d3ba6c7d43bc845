// Some answers of a log with what they name and nothing else: a small log to keep, to send, to test with.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "tools/replay/replay.h"

namespace tern {

/// A log that write_log wrote has a message on this channel: what is not in it was left out on purpose.
inline constexpr char kExtractMark[] = "TERN_EXTRACT";

/// Answers and all that they were made from.
struct Extract {
  RecordedInputs inputs;
  std::vector<TrackSet> predictions;  ///< complete sets, in the log's order: those named, and those that static tracks
                                      ///< were remembered from
};

/// @param options  which answers (its other settings are not used)
/// @param every  of those, keep every n-th, n ≥ 1
Result<Extract> extract(const std::string& path, const ReplayOptions& options, int every = 1);

/// Writes it as a log, which must not exist yet. A replay of it replays the same answers.
Result<void> write_log(const Extract& extract, const std::string& path);

/// Writes it as text (text_log.h), with a comment that says what was asked and answered. A replay takes it as a log; a
/// unit test takes it by load_fixture (tests/support/fixture.h).
Result<void> write_fixture(const Extract& extract, const std::string& path);

/// Extracts answers of the log at `path` into a log, a fixture, or both; an empty name: not that.
Result<void> write_extract(const std::string& path, const ReplayOptions& options, const std::string& log,
                           const std::string& fixture);

}  // namespace tern
