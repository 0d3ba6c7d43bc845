# tern_version: "0.2.0+<commit>", the build id that every message sender reports. Recomputed at each build.
file(WRITE ${CMAKE_BINARY_DIR}/version/write_version.cmake [[
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE COMMIT
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT COMMIT)
  set(COMMIT ${WITHOUT_GIT})
endif()
set(TEXT "#include \"runtime/version.h\"\nnamespace tern {\nconst char* build_id() { return \"${VERSION}+${COMMIT}\"; }\n}\n")
file(CONFIGURE OUTPUT ${OUT} CONTENT "${TEXT}" @ONLY)  # leaves an equal file alone
]])
set(TERN_COMMIT unknown CACHE STRING "Takes the commit's place in a tree without git, as that of a package")
add_custom_target(tern_write_version
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DWITHOUT_GIT=${TERN_COMMIT}
          -DOUT=${CMAKE_BINARY_DIR}/version/version.cpp -P ${CMAKE_BINARY_DIR}/version/write_version.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/version/version.cpp)

# planner_build(): a digest of all that plan() is compiled from. Recomputed at each build.
file(WRITE ${CMAKE_BINARY_DIR}/version/write_planner_build.cmake [[
file(GLOB_RECURSE FILES RELATIVE ${SOURCE} ${SOURCE}/core/*.h ${SOURCE}/core/*.cpp ${SOURCE}/planner/*.h ${SOURCE}/planner/*.cpp)
list(FILTER FILES EXCLUDE REGEX "^planner/app/")
list(SORT FILES)
set(ALL "${TOOLS}")
foreach(FILE ${FILES})
  file(SHA256 ${SOURCE}/${FILE} SUM)
  string(APPEND ALL "${FILE} ${SUM}\n")
endforeach()
string(SHA256 SUM "${ALL}")
string(SUBSTRING ${SUM} 0 16 SUM)
set(TEXT "#include \"planner/planner_build.h\"\nnamespace tern {\nstd::uint64_t planner_build() { return 0x${SUM}ULL; }\n}\n")
file(CONFIGURE OUTPUT ${OUT} CONTENT "${TEXT}" @ONLY)  # leaves an equal file alone
]])
string(TOUPPER "${CMAKE_BUILD_TYPE}" TERN_TYPE)
add_custom_target(tern_write_planner_build
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUT=${CMAKE_BINARY_DIR}/version/planner_build.cpp
          "-DTOOLS=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${TERN_TYPE}} Eigen ${Eigen3_VERSION} CGAL ${CGAL_VERSION} Ipopt ${IPOPT_VERSION}"
          -P ${CMAKE_BINARY_DIR}/version/write_planner_build.cmake
  BYPRODUCTS ${CMAKE_BINARY_DIR}/version/planner_build.cpp VERBATIM)
