# Tern's libraries as a package for other projects: find_package(tern COMPONENTS …), and a .pc file per component for
# pkg-config. Each component is an install component and an export set of its own, so a project needs only the packages
# of the components that it names.
include(CMakePackageConfigHelpers)

set(TERN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tern)

# tern_component(NAME LIBRARIES … HEADERS … [NOT …] [REQUIRES …] [LINKS …] ABOUT …)
#   LIBRARIES  targets, in the order in which a linker wants static libraries; tern_x is exported as tern::x
#   HEADERS    folders whose headers are installed; NOT: regular expressions of paths that stay behind
#   REQUIRES   pkg-config packages; LINKS: linker flags of libraries without a package
function(tern_component name)
  cmake_parse_arguments(ARG "" "ABOUT" "LIBRARIES;HEADERS;NOT;REQUIRES;LINKS" ${ARGN})
  set(flags "")
  foreach(library ${ARG_LIBRARIES})
    string(REGEX REPLACE "^tern_" "" exported ${library})
    set_target_properties(${library} PROPERTIES EXPORT_NAME ${exported})
    target_compile_features(${library} INTERFACE cxx_std_20)
    get_target_property(type ${library} TYPE)
    if(NOT type STREQUAL INTERFACE_LIBRARY)
      string(APPEND flags " -l${library}")
    endif()
  endforeach()
  install(TARGETS ${ARG_LIBRARIES} EXPORT tern-${name}-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name})
  install(EXPORT tern-${name}-targets NAMESPACE tern:: DESTINATION ${TERN_PACKAGE_DIR} COMPONENT ${name})

  foreach(folder ${ARG_HEADERS})
    set(left_behind "")
    foreach(pattern ${ARG_NOT})
      list(APPEND left_behind REGEX "${pattern}" EXCLUDE)
    endforeach()
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION include/tern/${folder} COMPONENT ${name}
            FILES_MATCHING PATTERN "*.h" ${left_behind})
  endforeach()

  set(TERN_PC_NAME ${name})
  set(TERN_PC_ABOUT ${ARG_ABOUT})
  set(TERN_PC_LIBS "${flags}")
  foreach(link ${ARG_LINKS})
    string(APPEND TERN_PC_LIBS " ${link}")
  endforeach()
  file(RELATIVE_PATH TERN_PC_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  list(JOIN ARG_REQUIRES ", " TERN_PC_REQUIRES)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/tern.pc.in ${PROJECT_BINARY_DIR}/tern-${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/tern-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${name})
endfunction()

# tern::core stands for all of core/; tern::base, tern::geometry and so on are its parts.
add_library(tern_core INTERFACE)
target_link_libraries(tern_core INTERFACE tern_base tern_convex_hull tern_drawing tern_geometry tern_scenario tern_splines tern_wire tern_world)

tern_component(core ABOUT "geometry, splines, and the values of Tern's messages"
  LIBRARIES tern_core tern_drawing tern_scenario tern_world tern_wire tern_geometry tern_convex_hull tern_splines tern_base
  HEADERS core
  REQUIRES eigen3 fmt LINKS -lglpk -lmpfr -lgmp)
# Generated types are used within messages/ alone.
tern_component(messages ABOUT "Tern's messages as bytes, and logs of flights"
  LIBRARIES tern_flight_log tern_messages
  HEADERS messages flight_log NOT "messages/(fields|form|wire)[.]h$"
  REQUIRES tern-core)
tern_component(planner ABOUT "plan(): one certified trajectory for one request"
  LIBRARIES tern_planner tern_planner_heading tern_planner_optimization tern_planner_search tern_planner_global_path tern_planner_semantics
            tern_planner_safety tern_planner_unseen
  HEADERS planner NOT "planner/app"
  REQUIRES tern-core)
tern_component(perception ABOUT "obstacles in depth pictures"
  LIBRARIES tern_perception
  HEADERS perception
  REQUIRES tern-core)
tern_component(predictor ABOUT "tracks of detections, and their predictions"
  LIBRARIES tern_predictor
  HEADERS predictor NOT "predictor/app"
  REQUIRES tern-perception)
tern_component(replay ABOUT "the inputs of every plan of a recorded flight"
  LIBRARIES tern_replay tern_planner_node tern_runtime
  HEADERS runtime planner/app tools/replay
  REQUIRES tern-planner tern-messages lcm libsodium yaml-cpp spdlog LINKS -pthread)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tern-config.cmake.in ${PROJECT_BINARY_DIR}/tern-config.cmake
                              INSTALL_DESTINATION ${TERN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tern-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tern-config.cmake ${PROJECT_BINARY_DIR}/tern-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindGLPK.cmake
        DESTINATION ${TERN_PACKAGE_DIR} COMPONENT core)

# `libraries` builds what the components install.
add_custom_target(libraries)
add_dependencies(libraries tern_replay tern_predictor tern_planner tern_flight_log)
