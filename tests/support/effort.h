// How much a run of the tests tries: one number for random properties, mutations, seeds and flights.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace tern::support {

/// What soak runs try (`launch_scripts/test.sh --all`): every count as it is written in the tests.
inline constexpr int kSoakEffort = 10;

/// TERN_EFFORT from the environment; 1 unless it is set: what a person waits for.
inline int effort() {
  const char* const asked = std::getenv("TERN_EFFORT");
  return asked == nullptr ? 1 : std::stoi(asked);
}

/// A number of random cases in proportion to the effort: a tenth of `soak` by default, `soak` at kSoakEffort, beyond it
/// more.
inline int at_effort(int soak) {
  const std::int64_t count = static_cast<std::int64_t>(soak) * effort() / kSoakEffort;
  return count < 1 ? 1 : static_cast<int>(count);
}

/// How many of `all` listed cases: `usual`, and all of them at kSoakEffort and beyond it.
inline int listed_at_effort(int usual, int all) { return effort() < kSoakEffort ? usual : all; }

/// The first `usual` of the listed cases; all of them at kSoakEffort and beyond it.
template <class Case>
std::vector<Case> first_at_effort(std::size_t usual, std::vector<Case> cases) {
  if (effort() < kSoakEffort && usual < cases.size())
    cases.erase(cases.begin() + static_cast<std::ptrdiff_t>(usual), cases.end());
  return cases;
}

}  // namespace tern::support
