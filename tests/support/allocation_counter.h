// Counts every allocation of an executable, operator new's and Eigen's: malloc and its kin are replaced. Link
// allocation_counter.cpp; not with sanitizers, which replace them too.
#pragma once

namespace tern::support {

/// Since the start of the process, by all threads.
long allocations_so_far();

}  // namespace tern::support
