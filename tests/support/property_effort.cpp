// rapidcheck's properties in every test program: a fixed seed, and as many cases as TERN_EFFORT asks for, unless
// RC_PARAMS says else.
#include <cstdlib>
#include <string>

#include "tests/support/effort.h"

namespace {
constexpr int kUsualCases = 100;  // rapidcheck's own number

// rapidcheck reads RC_PARAMS when it checks its first property, which is after this.
[[maybe_unused]] const int kSet =
    setenv("RC_PARAMS", ("seed=1 max_success=" + std::to_string(kUsualCases * tern::support::effort())).c_str(), 0);
}  // namespace
