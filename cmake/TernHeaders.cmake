# The headers that most of Tern's sources read. To read them takes more than half of the time that such a source takes to
# compile, so they are precompiled once. Every source still includes what it uses: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
# builds without. CLI11, nlohmann and spdlog do not pay here: each source would take longer by what they instantiate.
set(TERN_HEADERS <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <compare> <concepts> <cstdint> <deque>
  <fmt/format.h> <functional> <limits> <map> <memory> <optional> <set> <span> <string> <string_view> <tl/expected.hpp>
  <tuple> <utility> <variant> <vector>)

# A precompiled header is read only by what is compiled alike: these options and definitions are those of every source.
set(TERN_COMMON_OPTIONS -pthread -Wno-error=invalid-pch)
set(TERN_COMMON_DEFINITIONS $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers.cpp CONTENT "// Compiled beside the precompiled headers.\n")
add_library(tern_headers OBJECT ${CMAKE_BINARY_DIR}/headers.cpp)
target_link_libraries(tern_headers PRIVATE Eigen3::Eigen tl::expected fmt::fmt)
target_compile_options(tern_headers PRIVATE ${TERN_COMMON_OPTIONS})
target_precompile_headers(tern_headers PRIVATE ${TERN_HEADERS})

# tern_precompiled(NAME): compiles a target of tern_library() or tern_executable() with them.
function(tern_precompiled name)
  target_compile_options(${name} PRIVATE ${TERN_COMMON_OPTIONS})
  target_compile_definitions(${name} PRIVATE ${TERN_COMMON_DEFINITIONS})
  target_precompile_headers(${name} REUSE_FROM tern_headers)
endfunction()
