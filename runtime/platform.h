// The properties of compiler and machine on which floating-point results depend. Replays compare them.
#pragma once

#include <string>

namespace tern {

/// One line: compiler, build type and flags; CPU features by which libraries choose code; C library; the loaded BLAS.
///
///     GNU 12.2.0 Release -O2 -DNDEBUG; x86_64 avx avx2 fma sse4_2; glibc 2.36; BLAS /usr/lib/…/libblas.so.3.11.0
///
/// Equal build id and equal platform give equal bits.
const std::string& platform();

}  // namespace tern
