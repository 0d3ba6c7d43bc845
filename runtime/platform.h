// What floating-point results depend on besides the source: the promise of a replay is judged by it.
#pragma once

#include <string>

namespace tern {

/// One line: compiler, build type and flags; CPU features that libraries choose code by; C library; the BLAS in use.
/// "GNU 12.2.0 Release -O2 -DNDEBUG; x86_64 avx avx2 fma sse4_2; glibc 2.36; BLAS /usr/lib/…/libblas.so.3.11.0".
/// The same build id and the same platform mean the same bits. The BLAS is the one loaded into this process.
const std::string& platform();

}  // namespace tern
