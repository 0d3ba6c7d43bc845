# Writes a ctest entry for every suite of a test program, after it was linked (tern_test in tests/CMakeLists.txt). Run as
# cmake -DPROGRAM= -DENTRIES= -DCOST= -DSOAK= -DFIXTURES= -P:
# ENTRIES: the file to write. COST: about how many seconds a suite takes. SOAK: a regular expression of the suites that soak runs
# repeat at ten times the effort (tests/support/effort.h). FIXTURES: what all of them need.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${status}\n${listed}")
endif()
string(REPLACE ";" "," listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
set(entries "")
get_filename_component(program ${PROGRAM} NAME)
function(add_entry name suite properties)
  string(APPEND entries "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*:${suite}/*.*]=])\n"
    "set_tests_properties([=[${name}]=] PROPERTIES TIMEOUT 900 COST ${COST} ${properties})\n")
  set(entries "${entries}" PARENT_SCOPE)
endfunction()
set(suites "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.") # cases are indented
    string(REGEX REPLACE "/[0-9]+$" "" suite ${CMAKE_MATCH_1}) # one of the types of a typed suite
    list(APPEND suites ${suite})
  endif()
endforeach()
list(REMOVE_DUPLICATES suites)
set(needs "")
if(FIXTURES)
  set(needs "FIXTURES_REQUIRED [=[${FIXTURES}]=]")
endif()
foreach(suite IN LISTS suites)
  add_entry(${program}.${suite} ${suite} "${needs}")
  if(SOAK AND suite MATCHES "^(${SOAK})$")
    add_entry(Soak.${program}.${suite} ${suite} "LABELS soak ENVIRONMENT TERN_EFFORT=10 ${needs}")
  endif()
endforeach()
file(WRITE ${ENTRIES} "${entries}")
