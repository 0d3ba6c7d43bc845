// The effort of a test run: one number that scales random properties, mutations, seeds and flights.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace tern::support {

/// The effort of soak runs (`launch_scripts/test.sh --all`): all counts are as written in the tests.
inline constexpr int kSoakEffort = 10;

/// Returns TERN_EFFORT of the environment; 1 if it is not set.
inline int effort() {
  const char* const asked = std::getenv("TERN_EFFORT");
  return asked == nullptr ? 1 : std::stoi(asked);
}

/// Returns a number of random cases in proportion to the effort: `soak` at kSoakEffort, a tenth of it by default.
inline int at_effort(int soak) {
  const std::int64_t count = static_cast<std::int64_t>(soak) * effort() / kSoakEffort;
  return count < 1 ? 1 : static_cast<int>(count);
}

/// Returns how many of `all` listed cases are run: `usual`, or all from kSoakEffort on.
inline int listed_at_effort(int usual, int all) { return effort() < kSoakEffort ? usual : all; }

/// Returns the first `usual` of the listed cases, or all of them from kSoakEffort on.
template <class Case>
std::vector<Case> first_at_effort(std::size_t usual, std::vector<Case> cases) {
  if (effort() < kSoakEffort && usual < cases.size())
    cases.erase(cases.begin() + static_cast<std::ptrdiff_t>(usual), cases.end());
  return cases;
}

}  // namespace tern::support
