# tern_version: "0.1.0+<commit>", the build id that every message sender reports. Recomputed at each build.
file(WRITE ${CMAKE_BINARY_DIR}/version/write_version.cmake [[
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE COMMIT
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT COMMIT)
  set(COMMIT unknown)
endif()
set(TEXT "#include \"runtime/version.h\"\nnamespace tern {\nconst char* build_id() { return \"${VERSION}+${COMMIT}\"; }\n}\n")
set(OLD "")
if(EXISTS ${OUT})
  file(READ ${OUT} OLD)
endif()
if(NOT OLD STREQUAL TEXT)
  file(WRITE ${OUT} "${TEXT}")
endif()
]])
add_custom_target(tern_write_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
          -DOUT=${CMAKE_BINARY_DIR}/version/version.cpp -P ${CMAKE_BINARY_DIR}/version/write_version.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/version/version.cpp)
