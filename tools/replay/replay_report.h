// What a replay found, for people and for programs.
#pragma once

#include <string>

#include "tools/replay/replay.h"

namespace tern {

/// What the log holds and lacks, which promise holds, how many answers match, and where the first that does not parts.
/// @param what_if  other settings were asked for: what changes is told, not judged
std::string replay_text(const Replay& replay, bool what_if);

/// The same with a line per answer, as JSON.
std::string replay_json(const Replay& replay, bool what_if);

/// 0: every answer is as promised; 1: one is not; 3: nothing differs, but something is missing. What-if: 0 or 3.
int replay_exit_code(const Replay& replay, bool what_if);

}  // namespace tern
