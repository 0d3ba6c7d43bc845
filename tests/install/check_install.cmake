# Installs core into WORK/prefix, then configures, builds and runs CONSUMER against it.
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${TERN_BUILD} --prefix ${WORK}/prefix --component core)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)

# CGAL's rounding flag must not reach those who only link.
file(STRINGS ${WORK}/build/compile_commands.json leaked REGEX "frounding-math")
if(leaked)
  message(FATAL_ERROR "CGAL's compile options leak to consumers: ${leaked}")
endif()
