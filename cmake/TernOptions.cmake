# Compiler settings that hold for every target of Tern.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

# A fused multiply-add would make results depend on the compiler's mood; replays promise bytes.
add_compile_options(-ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  add_compile_options(-include ${PROJECT_SOURCE_DIR}/cmake/arm64_unfused.h)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)  # g++ uses a precompiled header only if nothing comes before it
endif()

# The Python module is a shared object: its code must be position independent. All is compiled so, thus once, for programs
# and module. The second option lets g++ inline as it does for programs.
add_compile_options(-fPIC -fno-semantic-interposition)

find_program(TERN_CCACHE ccache)
if(TERN_CCACHE)
  # What ccache asks for where headers are precompiled (its manual, "Precompiled headers").
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${TERN_CCACHE})
endif()

# The last four: false alarms of g++ 12 in std::string, which come and go with what is precompiled and with the length of
# the checkout's path.
set(TERN_WARNINGS -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wno-restrict -Wno-array-bounds
                  -Wno-stringop-overflow -Wno-stringop-overread)
# Of the compiler that they are held against; a newer one's new warnings shall not keep a user from flying.
if(TERN_WARNINGS_AS_ERRORS AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND TERN_WARNINGS -Werror)
endif()

# tern_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...] [NOT_PRECOMPILED]): a static library with headers found from the
# project's root. NOT_PRECOMPILED: its flags are not those of the precompiled headers (TernHeaders.cmake).
function(tern_library name)
  cmake_parse_arguments(ARG "NOT_PRECOMPILED" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/tern>)
  target_compile_options(${name} PRIVATE ${TERN_WARNINGS})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(NOT ARG_NOT_PRECOMPILED)
    tern_precompiled(${name})
  endif()
endfunction()

# tern_executable(NAME SOURCES ... LIBS ...)
function(tern_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${TERN_WARNINGS})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  tern_precompiled(${name})
  set_property(GLOBAL APPEND PROPERTY TERN_EXECUTABLES ${name})
endfunction()
