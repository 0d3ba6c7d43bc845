// The build id, "0.2.0+<commit>", written by the build (cmake/TernVersion.cmake).
#pragma once

namespace tern {

const char* build_id();

}  // namespace tern
