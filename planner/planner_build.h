// Which plan() this is: two builds of the same digest on the same platform() give the same bytes.
#pragma once

#include <cstdint>

namespace tern {

/// Digest of the sources of core/ and planner/ (without app/), compiler and flags, and the versions of the libraries
/// that plan() computes with. Made anew by each build (cmake/TernVersion.cmake); a change elsewhere, or a commit, does
/// not change it.
std::uint64_t planner_build();

}  // namespace tern
