# `cmake --install`: the programs with tern-viewer's page, if it was built; what they fly and the scripts (share/tern);
# the messages for other languages. core/ is a package for others (find_package(tern); target tern::core).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(TERN_CORE_LIBRARIES tern_base tern_convex_hull tern_geometry tern_splines tern_world)
set(TERN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/tern)

# tern::core stands for all of core/; tern::base, tern::geometry and so on are its parts.
add_library(tern_core INTERFACE)
target_link_libraries(tern_core INTERFACE ${TERN_CORE_LIBRARIES})
target_compile_features(tern_core INTERFACE cxx_std_20)
foreach(library tern_core ${TERN_CORE_LIBRARIES})
  string(REGEX REPLACE "^tern_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()

install(TARGETS tern_core ${TERN_CORE_LIBRARIES} EXPORT tern-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core/ DESTINATION include/tern/core COMPONENT core
        FILES_MATCHING PATTERN "*.h")
install(EXPORT tern-targets NAMESPACE tern:: DESTINATION ${TERN_PACKAGE_DIR} COMPONENT core)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/tern-config.cmake.in ${PROJECT_BINARY_DIR}/tern-config.cmake
                              INSTALL_DESTINATION ${TERN_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tern-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tern-config.cmake ${PROJECT_BINARY_DIR}/tern-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindGLPK.cmake
        DESTINATION ${TERN_PACKAGE_DIR} COMPONENT core)

# Programs are the executables named tern-…; tests and benchmarks stay behind. `apps` builds them all.
add_custom_target(apps)
get_property(executables GLOBAL PROPERTY TERN_EXECUTABLES)
foreach(program ${executables})
  if(program MATCHES "^tern-")
    add_dependencies(apps ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()

# What every flight needs: fly.sh builds no more. Its options add their own programs (launch_scripts/fly.sh).
add_custom_target(flight)
add_dependencies(flight tern-launch tern-simulator tern-predictor tern-planner tern-executor tern-mapper tern-monitor
                 tern-logger)

# The scripts find programs and scenarios from their own place (launch_scripts/lib.sh).
foreach(folder scenarios launch_scripts lcmtypes)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION share/tern COMPONENT programs USE_SOURCE_PERMISSIONS
          PATTERN CMakeLists.txt EXCLUDE PATTERN build.sh EXCLUDE PATTERN test.sh EXCLUDE PATTERN install.sh EXCLUDE
          PATTERN record_golden.sh EXCLUDE PATTERN results.sh EXCLUDE PATTERN view_page.sh EXCLUDE
          PATTERN campaign_slurm.sh EXCLUDE PATTERN packages*.txt EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/python/tern_msgs DESTINATION share/tern/python COMPONENT programs OPTIONAL)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/docs/licensing.md DESTINATION share/doc/tern
        COMPONENT programs)
