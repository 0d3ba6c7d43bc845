// Reports a replay as text for people and as JSON for programs.
#pragma once

#include <string>

#include "tools/replay/replay.h"

namespace tern {

/// Text: contents and gaps of the log, the precision that is promised, the number of equal answers, and the first
/// difference.
/// @param what_if  the settings differ from the recorded ones, so differences are listed but not judged
std::string replay_text(const Replay& replay, bool what_if);

/// Returns the report as JSON, with a line per answer.
std::string replay_json(const Replay& replay, bool what_if);

/// 0: all answers agree as promised; 1: an answer differs; 3: no answer differs, but the log lacks something. With
/// `what_if`: 0 or 3.
int replay_exit_code(const Replay& replay, bool what_if);

}  // namespace tern
