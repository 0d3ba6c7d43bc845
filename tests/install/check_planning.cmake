# Installs the components into WORK/prefix. Builds CONSUMER against them by find_package() and by pkg-config, and runs both
# on LOG. A project that plans without logs needs no package of pkg-config, nor Ipopt.
file(REMOVE_RECURSE ${WORK})
foreach(component core messages perception planner predictor replay)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${TERN_BUILD} --prefix ${WORK}/prefix --component ${component}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()

set(configure ${CMAKE_COMMAND} -S ${CONSUMER} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
execute_process(COMMAND ${configure} -B ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/build/planning_consumer ${LOG} COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE pc ${WORK}/prefix/tern-replay.pc)
get_filename_component(pc ${pc} DIRECTORY)
set(flags "$(PKG_CONFIG_PATH=${pc} pkg-config --cflags --libs tern-replay tern-predictor)")
execute_process(COMMAND sh -c "${CXX} ${CXX_FLAGS} -std=c++20 ${CONSUMER}/main.cpp -o ${WORK}/by_pkg_config ${flags}"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/by_pkg_config ${LOG} COMMAND_ERROR_IS_FATAL ANY)

# Without LCM a project that reads logs is told what it lacks. (An empty PKG_CONFIG_LIBDIR hides every package.)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_LIBDIR=${WORK} PKG_CONFIG_PATH= ${configure} -B ${WORK}/without
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
string(REGEX REPLACE "[ \n]+" " " said "${said}")
if(result EQUAL 0 OR NOT said MATCHES "component replay needs lcm \\(Debian: liblcm-dev\\), libsodium")
  message(FATAL_ERROR "not told that LCM is missing: ${said}")
endif()
file(WRITE ${WORK}/plans_only/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.22)\nproject(plans_only CXX)\nfind_package(tern REQUIRED COMPONENTS planner predictor)\n")
list(TRANSFORM configure REPLACE "^${CONSUMER}$" ${WORK}/plans_only)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_LIBDIR=${WORK} PKG_CONFIG_PATH= ${configure}
                -B ${WORK}/plans_only/build OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${WORK}/unknown/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.22)\nproject(unknown CXX)\nfind_package(tern REQUIRED COMPONENTS plannner)\n")
list(TRANSFORM configure REPLACE "^${WORK}/plans_only$" ${WORK}/unknown)
execute_process(COMMAND ${configure} -B ${WORK}/unknown/build RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
if(result EQUAL 0 OR NOT said MATCHES "no component plannner")
  message(FATAL_ERROR "a wrong component is not named: ${said}")
endif()
