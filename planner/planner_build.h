// The identity of plan(): two builds with the same digest on the same platform() give the same bytes.
#pragma once

#include <cstdint>

namespace tern {

/// Returns a digest of the sources of core/ and planner/ (without app/), the compiler, its flags and the library
/// versions. Each build makes it (cmake/TernVersion.cmake). A commit, or a change in another folder, does not change
/// it.
std::uint64_t planner_build();

}  // namespace tern
