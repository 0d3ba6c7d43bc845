// How far a fuzz test looks.
#pragma once

#include <cstdlib>
#include <string>

namespace tern::support {

/// TERN_FUZZ_COUNT from the environment, else `usual`: mutations per case.
inline int fuzz_count(int usual) {
  const char* const asked = std::getenv("TERN_FUZZ_COUNT");
  return asked == nullptr ? usual : std::stoi(asked);
}

}  // namespace tern::support
