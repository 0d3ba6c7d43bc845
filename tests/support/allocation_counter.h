// Counts all allocations of an executable, those of Eigen included, by replacing malloc and related functions. Link
// allocation_counter.cpp to use it. It does not work with sanitizers, which replace the same functions.
#pragma once

namespace tern::support {

/// Returns the number of allocations since the start of the process, by all threads.
long allocations_so_far();

}  // namespace tern::support
